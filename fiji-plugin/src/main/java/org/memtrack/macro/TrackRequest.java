// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import static org.memtrack.macro.TrackOption.*;

import java.nio.file.Path;
import java.util.Map;
import java.util.OptionalDouble;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Thresholds;
import org.memtrack.detection.DetectorException;
import org.memtrack.run.TrackingSettings;
import org.memtrack.server.ServerSettings;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.TrackFilter;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;

/**
 * What the user wants from "MEMTrack Track", said in a macro or a dialog.
 *
 * @param output folder for the results
 * @param film what of the image is the film
 * @param settings how to track; the region comes from the image's selection
 * @param overlay whether to draw the tracks over the open film
 * @param options every option by its key, defaults included; those of {@link OptionLine#format} repeat the run
 */
public record TrackRequest(
        Path output, FilmOptions film, TrackingSettings settings, boolean overlay, Map<String, String> options) {

    /**
     * The request that these options make; what is left out has its default, never the last value of the dialog.
     *
     * @throws DetectorException when an option is unknown, or its value wrong
     */
    public static TrackRequest of(Map<String, String> options) {
        OptionValues values = new OptionValues(options);
        if (!values.given(OUTPUT)) {
            throw new DetectorException(
                    "No folder for the results is given: choose the output folder (in a macro: output=[/path/to/folder]).");
        }
        try {
            return new TrackRequest(
                    GivenPath.of(values.text(OUTPUT)).toAbsolutePath(),
                    film(values),
                    new TrackingSettings(detection(values), tracking(values), server(values), secondLook(values)),
                    values.flag(OVERLAY),
                    values.asMap());
        } catch (IllegalArgumentException e) {
            // Values are checked where they are kept; here their message becomes the user's sentence.
            throw new DetectorException(e.getMessage() + ": change that option.", e);
        }
    }

    /**
     * The settings for a film of that many frames: the preset's least length of a track, unless min_length was given, is
     * at most half the film, since few cells of a shorter film could be seen for longer.
     */
    public TrackingSettings settingsFor(int frameCount) {
        SortSettings tracking = settings.tracking();
        int longest = Math.max(1, frameCount / 2);
        TrackFilter filter = tracking.filter();
        if (options.containsKey(MIN_LENGTH.key()) || filter.minimumLength() <= longest) {
            return settings;
        }
        int ifSure = options.containsKey(MIN_LENGTH_SURE.key())
                ? filter.minimumLengthIfSure()
                : TrackFilter.ofSwimmers(longest).minimumLengthIfSure();
        TrackFilter shorter = new TrackFilter(longest, ifSure, filter.minimumScore());
        return settings.with(tracking.with(shorter));
    }

    /** Who gives thresholds wants nothing below them. */
    private static boolean secondLook(OptionValues values) {
        return values.flag(SECOND_LOOK) && thresholds(values) == null;
    }

    private static FilmOptions film(OptionValues values) {
        return new FilmOptions(
                values.choice(FRAMES, FrameAxis.class),
                values.integer(CHANNEL).orElse(1),
                values.integer(FIRST_FRAME).orElse(1),
                values.integer(LAST_FRAME).orElse(0),
                values.number(PIXEL_SIZE),
                values.number(FRAME_INTERVAL));
    }

    private static DetectionSettings detection(OptionValues values) {
        return new DetectionSettings(
                values.text(MODEL).equals(MODEL.defaultValue()) ? "" : values.text(MODEL),
                values.text(MODEL_VERSION),
                values.choice(CRITERION, Criterion.class),
                thresholds(values),
                orNull(values.number(MAX_SIZE)),
                orNull(values.number(NMS_IOU)),
                values.flag(STABILISE),
                orNull(values.number(CELL_LENGTH)),
                null);
    }

    private static @Nullable Thresholds thresholds(OptionValues values) {
        OptionalDouble low = values.number(THRESHOLD_LOW);
        OptionalDouble medium = values.number(THRESHOLD_MEDIUM);
        OptionalDouble high = values.number(THRESHOLD_HIGH);
        if (low.isEmpty() && medium.isEmpty() && high.isEmpty()) {
            return null;
        }
        if (low.isEmpty() || medium.isEmpty() || high.isEmpty()) {
            throw new DetectorException(
                    "Only some thresholds are given: give threshold_low, threshold_medium and threshold_high, or none.");
        }
        return new Thresholds(low.getAsDouble(), medium.getAsDouble(), high.getAsDouble());
    }

    private static SortSettings tracking(OptionValues values) {
        SortSettings preset = values.choice(PRESET, SortSettings.class);
        return new SortSettings(
                values.choice(ASSOCIATION, Association.class),
                values.number(IOU_GATE).orElse(preset.iouGate()),
                values.integer(MAX_AGE).orElse(preset.maximumAge()),
                values.integer(MIN_HITS).orElse(preset.minimumHits()),
                values.choice(INTERPOLATION, Interpolation.class),
                filter(values, preset.filter()));
    }

    private static TrackFilter filter(OptionValues values, TrackFilter preset) {
        // Who asks for a length gets no shorter track, however sure it is.
        return new TrackFilter(
                values.integer(MIN_LENGTH).orElse(preset.minimumLength()),
                values.integer(MIN_LENGTH_SURE)
                        .orElse(values.integer(MIN_LENGTH).orElse(preset.minimumLengthIfSure())),
                values.number(MIN_SCORE).orElse(preset.minimumScore()));
    }

    private static ServerSettings server(OptionValues values) {
        return new ServerSettings(
                values.given(SERVER) ? values.text(SERVER) : null,
                values.given(PYTHON) ? GivenPath.of(values.text(PYTHON)) : null);
    }

    private static @Nullable Double orNull(OptionalDouble value) {
        return value.isPresent() ? value.getAsDouble() : null;
    }
}
