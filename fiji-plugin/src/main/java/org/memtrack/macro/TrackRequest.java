// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import static org.memtrack.macro.TrackOption.*;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
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
                    output(values),
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

    /**
     * The options that say all of {@link #settingsFor}, whatever the defaults of another version are: those of the request,
     * with the lengths, the second look and the smoothing that were in force.
     */
    public Map<String, String> optionsFor(int frameCount) {
        TrackingSettings inForce = settingsFor(frameCount);
        TrackFilter filter = inForce.tracking().filter();
        Map<String, String> all = new LinkedHashMap<>(options);
        all.put(MIN_LENGTH.key(), Integer.toString(filter.minimumLength()));
        all.put(MIN_LENGTH_SURE.key(), Integer.toString(filter.minimumLengthIfSure()));
        all.put(SECOND_LOOK.key(), Boolean.toString(inForce.secondLook()));
        all.put(SMOOTH.key(), Boolean.toString(inForce.tracking().smooth()));
        return all;
    }

    /** Where a film of that many frames is tracked in another way than the options say, one sentence each. */
    public List<String> warningsFor(int frameCount) {
        List<String> warnings = new ArrayList<>();
        int inForce = settingsFor(frameCount).tracking().filter().minimumLength();
        int usual = settings.tracking().filter().minimumLength();
        if (inForce != usual) {
            warnings.add(
                    "The film is short: tracks of %d frames are kept, not only those of %d; %s sets another length."
                            .formatted(inForce, usual, MIN_LENGTH.bothNames()));
        }
        if (!settings.secondLook() && Boolean.parseBoolean(options.get(SECOND_LOOK.key()))) {
            warnings.add("%s is off, as %s."
                    .formatted(
                            SECOND_LOOK.bothNames(),
                            settings.detection().thresholds() == null
                                    ? INTERPOLATION.bothNames() + " is authors"
                                    : "thresholds are given"));
        }
        return warnings;
    }

    /** A part of a path would lead from the folder that Fiji was started in, which users do not know. */
    private static Path output(OptionValues values) {
        Path folder = GivenPath.of(values.text(OUTPUT));
        if (!folder.isAbsolute()) {
            throw new DetectorException(
                    "The output folder \"%s\" would lie wherever Fiji was started: give its whole path, as in /films/tracks or C:/films/tracks."
                            .formatted(folder));
        }
        return folder;
    }

    /** Who gives thresholds wants nothing below them, and the authors look once. */
    private static boolean secondLook(OptionValues values) {
        return values.flag(SECOND_LOOK)
                && thresholds(values) == null
                && values.choice(INTERPOLATION, Interpolation.class) == Interpolation.FILL_GAPS;
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
                values.flag(RESTING),
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
            throw new DetectorException("Only some thresholds are given: give all three, %s, %s and %s, or none."
                    .formatted(THRESHOLD_LOW.bothNames(), THRESHOLD_MEDIUM.bothNames(), THRESHOLD_HIGH.bothNames()));
        }
        return new Thresholds(low.getAsDouble(), medium.getAsDouble(), high.getAsDouble());
    }

    private static SortSettings tracking(OptionValues values) {
        SortSettings preset = values.choice(PRESET, SortSettings.class);
        Interpolation interpolation = values.choice(INTERPOLATION, Interpolation.class);
        return new SortSettings(
                values.choice(ASSOCIATION, Association.class),
                values.number(IOU_GATE).orElse(preset.iouGate()),
                values.integer(MAX_AGE).orElse(preset.maximumAge()),
                values.integer(MIN_HITS).orElse(preset.minimumHits()),
                interpolation,
                values.flag(SMOOTH) && interpolation == Interpolation.FILL_GAPS,
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
