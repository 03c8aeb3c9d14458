// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.gui.components.ConfigurationPanel;
import ij.ImagePlus;
import java.util.LinkedHashMap;
import java.util.Map;
import javax.swing.JComboBox;
import javax.swing.JSpinner;
import org.jspecify.annotations.Nullable;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.TrackFilter;

/** The tracker's settings in TrackMate's wizard. */
final class TrackerPanel extends ConfigurationPanel {
    private static final long serialVersionUID = 1;

    private final JComboBox<Choice<Association>> association = new JComboBox<>(Choice.ASSOCIATIONS);
    private final JSpinner iouGate = Form.number(0.05, 0, 0.99, 0.05);
    private final JSpinner maximumAge = Form.whole(25, 0, 100_000);
    private final JSpinner minimumHits = Form.whole(0, 0, 100_000);
    private final JComboBox<Choice<Interpolation>> interpolation = new JComboBox<>(Choice.INTERPOLATIONS);
    private final JSpinner minimumTrackLength = Form.whole(60, 1, 1_000_000);
    private final JSpinner minimumTrackLengthIfSure = Form.whole(15, 1, 1_000_000);
    private final JSpinner minimumTrackScore = Form.number(0.3, 0, 1, 0.05);

    TrackerPanel(@Nullable ImagePlus image) {
        Form form = new Form(this);
        form.title(
                MemtrackTrackerFactory.NAME,
                "Joins the spots of any detector and fills in where a track was not seen for a while.");
        form.row(
                "Association",
                association,
                "Which spot continues which track: the one that a swimmer which runs and tumbles most likely is, which mixes"
                        + " up fewer of them, or the one whose box overlaps the predicted one most, as in the paper.");
        form.row(
                "Least overlap (IoU)",
                iouGate,
                "Intersection over union that a spot's box must have with the predicted one, 0 to 0.99; the paper's"
                        + " authors use 0.05. Used when associating by overlap.");
        form.row(
                "Maximum age (frames)",
                maximumAge,
                "For how many frames a track goes on without a spot before it ends; 25 in the paper.");
        form.row(
                "Minimum hits", minimumHits, "How many spots a track needs: with fewer it is dropped; 0 in the paper.");
        form.row(
                "Where no spot was found",
                interpolation,
                "Fill the gaps between two spots of a track, or go on by prediction for up to the"
                        + " maximum age, also after a track's last spot, as the paper's authors do.");
        form.row(
                "Least track length (frames)",
                minimumTrackLength,
                "Shorter tracks are dropped, interpolated frames counted; 60 in collagen and 30 in water in the paper.");
        form.row(
                "Least length of sure tracks",
                minimumTrackLengthIfSure,
                "The same for tracks that are sure to be real: they begin or end at the edge of the film, which cuts them"
                        + " short, or their track score, as below, is at least " + TrackFilter.SURE_SCORE + ".");
        form.row(
                "Least track score",
                minimumTrackScore,
                "Mean quality of a track's frames, an interpolated one counting as 0; asked of spots of the MEMTrack"
                        + " detector only. 0 as in the paper.");
        if (image != null && image.getNFrames() > 1) {
            form.sentence(lengthAdvice(image.getNFrames()));
        }
        form.sentence("Spots put where none was found carry the feature “Interpolated”; colour or filter by it.");
        form.fill();
        setSettings(TrackerSettings.MAP.defaults());
    }

    /** The least length that the menu command would take by itself is half a short film. */
    static String lengthAdvice(int frames) {
        int half = Math.max(1, frames / 2);
        return half >= SortSettings.DEFAULTS.filter().minimumLength()
                ? "This film has %d frames.".formatted(frames)
                : "This film has only %d frames: a least track length of %d or less suits it.".formatted(frames, half);
    }

    @Override
    public void setSettings(Map<String, Object> settings) {
        Choice.select(association, settings.get(TrackerSettings.ASSOCIATION));
        iouGate.setValue(settings.get(TrackerSettings.IOU_GATE));
        maximumAge.setValue(settings.get(TrackerSettings.MAXIMUM_AGE));
        minimumHits.setValue(settings.get(TrackerSettings.MINIMUM_HITS));
        Choice.select(interpolation, settings.get(TrackerSettings.INTERPOLATION));
        minimumTrackLength.setValue(settings.get(TrackerSettings.MINIMUM_TRACK_LENGTH));
        minimumTrackLengthIfSure.setValue(settings.get(TrackerSettings.MINIMUM_TRACK_LENGTH_IF_SURE));
        minimumTrackScore.setValue(settings.get(TrackerSettings.MINIMUM_TRACK_SCORE));
    }

    @Override
    public Map<String, Object> getSettings() {
        Map<String, Object> settings = new LinkedHashMap<>();
        settings.put(TrackerSettings.ASSOCIATION, Choice.selected(association));
        settings.put(TrackerSettings.IOU_GATE, ((Number) iouGate.getValue()).doubleValue());
        settings.put(TrackerSettings.MAXIMUM_AGE, maximumAge.getValue());
        settings.put(TrackerSettings.MINIMUM_HITS, minimumHits.getValue());
        settings.put(TrackerSettings.INTERPOLATION, Choice.selected(interpolation));
        settings.put(TrackerSettings.MINIMUM_TRACK_LENGTH, minimumTrackLength.getValue());
        settings.put(TrackerSettings.MINIMUM_TRACK_LENGTH_IF_SURE, minimumTrackLengthIfSure.getValue());
        settings.put(TrackerSettings.MINIMUM_TRACK_SCORE, ((Number) minimumTrackScore.getValue()).doubleValue());
        return settings;
    }

    /** There is no preview to clean up. */
    @Override
    public void clean() {}
}
