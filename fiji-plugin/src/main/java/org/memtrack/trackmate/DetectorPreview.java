// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.TrackMate;
import ij.ImagePlus;
import java.util.Map;
import javax.swing.JButton;
import javax.swing.JLabel;
import javax.swing.SwingUtilities;
import org.jspecify.annotations.Nullable;

/**
 * Detects in the frame the user looks at.
 *
 * <p>The detector knows bacteria by how they differ from the film's background, so a single frame is not enough: the frames
 * around it are looked at, too.
 */
final class DetectorPreview {
    /** Frames to each side; at 60 a second a swimmer has left its place by then. */
    static final int REACH = 30;

    private final Settings settings;
    private final Model model;
    private final JButton button;
    private final JLabel state;
    private volatile @Nullable TrackMate running;

    DetectorPreview(Settings settings, Model model, JButton button, JLabel state) {
        this.settings = settings;
        this.model = model;
        this.button = button;
        this.state = state;
    }

    /** Starts a preview in a thread of its own, or cancels the one that runs. */
    void startOrCancel(Map<String, Object> detectorSettings) {
        TrackMate current = running;
        if (current != null) {
            current.cancel("preview");
            return;
        }
        ImagePlus film = settings.imp;
        if (film == null) {
            state.setText("Open a film to preview.");
            return;
        }
        int frame = film.getFrame() - 1;
        TrackMate trackmate = trackmate(film, frame, detectorSettings);
        running = trackmate;
        button.setText("Cancel");
        Thread thread = new Thread(() -> run(trackmate, frame), "MEMTrack preview");
        thread.setDaemon(true);
        thread.start();
    }

    /** Stops the preview that runs, if any. */
    void cancel() {
        TrackMate current = running;
        if (current != null) {
            current.cancel("preview");
        }
    }

    private TrackMate trackmate(ImagePlus film, int frame, Map<String, Object> detectorSettings) {
        Settings local = new Settings(film);
        local.tstart = Math.max(0, frame - REACH);
        local.tend = Math.min(film.getNFrames() - 1, frame + REACH);
        local.detectorFactory = new MemtrackDetectorFactory<>();
        local.detectorSettings = detectorSettings;
        TrackMate trackmate = new TrackMate(local);
        trackmate.getModel().setLogger(new LabelLogger(state));
        return trackmate;
    }

    private void run(TrackMate trackmate, int frame) {
        LabelLogger logger = new LabelLogger(state);
        try {
            if (!trackmate.execDetection()) {
                logger.error(trackmate.getErrorMessage());
            } else if (trackmate.isCanceled()) {
                logger.log("Preview cancelled.");
            } else {
                int shown = show(trackmate.getModel().getSpots(), frame);
                Settings local = trackmate.getSettings();
                logger.log("%d spots in frame %d, as seen with frames %d to %d."
                        .formatted(shown, frame + 1, local.tstart + 1, local.tend + 1));
            }
        } finally {
            running = null;
            SwingUtilities.invokeLater(() -> button.setText("Preview"));
        }
    }

    private int show(SpotCollection found, int frame) {
        SpotCollection shown = new SpotCollection();
        int count = 0;
        if (found.keySet().contains(frame)) {
            for (Spot spot : found.iterable(frame, false)) {
                shown.add(spot, frame);
                count++;
            }
        }
        model.setSpots(shown, true);
        return count;
    }
}
