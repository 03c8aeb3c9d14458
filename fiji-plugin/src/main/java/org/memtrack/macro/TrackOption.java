// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.function.Function;
import java.util.stream.Stream;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionSettings;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.TrackFilter;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;

/** An option of the command "MEMTrack Track": the one table that macro, dialog, recorder and manual derive from. */
public enum TrackOption {
    OUTPUT(
            "output",
            "Output folder",
            Kind.FOLDER,
            "",
            "folder for the results, its whole path; made if missing. Required"),
    PRESET(
            "preset",
            "Medium",
            "collagen",
            "least length of a track: 60 frames in collagen, 30 in water",
            new TreeMap<>(Map.of("collagen", SortSettings.COLLAGEN, "water", SortSettings.WATER))),
    CRITERION(
            "criterion",
            "Thresholds for",
            DetectionSettings.DEFAULTS.criterion().label(),
            "how sure of a cell to be: maximum precision for few false ones, maximum F1 for few false and few missed ones",
            choices(Criterion.values(), Criterion::label)),
    MODEL(
            "model",
            "Model",
            Kind.TEXT,
            "default",
            "name of the model: default, or one of your own; where a film is crowded, crowded takes over from default by itself"),
    PIXEL_SIZE(
            "pixel_size",
            "Pixel size (um)",
            Kind.NUMBER,
            "",
            "edge of a pixel in um; the image's own if left out; with it cells are taken to be 2 um long, unless Cell length (cell_length) is given"),
    FRAME_INTERVAL(
            "frame_interval",
            "Frame interval (s)",
            Kind.NUMBER,
            "",
            "time between two frames in s; if left out, the image's own, of an AVI that of the rate at which it plays"),
    CELL_LENGTH(
            "cell_length",
            "Cell length (px)",
            Kind.NUMBER,
            "",
            "length of a cell as it looks in the film, 1 to 200 pixels; by it the film is brought to the model's scale; if left out, cells are taken to be 2 um long, or without a pixel size the film is used as it is; much longer ones are recognised; the dialog begins with that of a straight line that is selected"),
    STABILISE("stabilise", "Undo drift of the stage", Kind.SWITCH, "true", "measure and undo the drift of the stage"),
    RESTING(
            "resting",
            "Find resting cells, too",
            Kind.SWITCH,
            "false",
            "find cells that never move, too: what stays in its place and is as dark or as bright as the cells that move, so that some debris comes with it; only for clear media"),
    OVERLAY("overlay", "Show tracks on the film", Kind.SWITCH, "true", "draw boxes and tracks over the open film"),

    FRAMES(
            "frames",
            "Frames lie on",
            word(FilmOptions.DEFAULTS.frameAxis()),
            "dimension of the image that holds the frames",
            choices(FrameAxis.values(), TrackOption::word)),
    CHANNEL("channel", "Channel", Kind.INTEGER, "1", "channel to use, counted from 1"),
    FIRST_FRAME("first_frame", "First frame", Kind.INTEGER, "1", "first frame to use, counted from 1"),
    LAST_FRAME(
            "last_frame", "Last frame", Kind.INTEGER, "", "last frame to use, counted from 1; the film's if left out"),
    MODEL_VERSION("model_version", "Version of the model", Kind.TEXT, "", "the newest if left out"),
    THRESHOLD_LOW(
            "threshold_low",
            "Threshold, low level",
            Kind.NUMBER,
            "",
            "least score, 0 to 1, of boxes that the detector takes for slow cells (level low); give all three thresholds or none"),
    THRESHOLD_MEDIUM("threshold_medium", "Threshold, medium level", Kind.NUMBER, "", "likewise for the level medium"),
    THRESHOLD_HIGH("threshold_high", "Threshold, high level", Kind.NUMBER, "", "likewise for fast cells (level high)"),
    MAX_SIZE(
            "max_size",
            "Greatest size (px)",
            Kind.NUMBER,
            "",
            "wider or taller boxes are dropped; in pixels at the model's scale, not the film's, where all boxes of the shipped models are 30 wide, so that 30 or less is refused and more drops none; 35 if left out"),
    NMS_IOU(
            "nms_iou",
            "Greatest overlap (IoU)",
            Kind.NUMBER,
            "",
            "of two boxes that overlap more, 0 to 1, the weaker is dropped; 0.7 if left out"),
    MIN_LENGTH(
            "min_length",
            "Least track length (frames)",
            Kind.INTEGER,
            "",
            "shorter tracks are dropped; if left out, as Medium (preset) says, and at most half the film's frames"),
    MIN_LENGTH_SURE(
            "min_length_sure",
            "Least length of sure tracks (frames)",
            Kind.INTEGER,
            "",
            "likewise for tracks that are sure to be real, as the edge of the field cuts them off or their mean score is at least "
                    + TrackFilter.SURE_SCORE
                    + "; if left out, Least track length (min_length) where that is given, or else a quarter of that of other tracks"),
    MIN_SCORE(
            "min_score",
            "Least track score",
            Kind.NUMBER,
            String.valueOf(SortSettings.DEFAULTS.filter().minimumScore()),
            "least mean score of a track's frames, 0 to 1, an interpolated frame counting as 0; 0 as in the paper"),
    SECOND_LOOK(
            "second_look",
            "Look again for faint cells",
            Kind.SWITCH,
            "true",
            "track what the thresholds drop too, and keep cells that travel and are found again and again; off in the paper, where thresholds are given, and where Interpolation (interpolation) is authors"),
    MAX_AGE(
            "max_age",
            "Maximum age (frames)",
            Kind.INTEGER,
            number(SortSettings.DEFAULTS.maximumAge()),
            "frames a track may go on without a detection"),
    MIN_HITS(
            "min_hits",
            "Minimum hits",
            Kind.INTEGER,
            number(SortSettings.DEFAULTS.minimumHits()),
            "detections a track needs"),
    IOU_GATE(
            "iou_gate",
            "IoU gate",
            Kind.NUMBER,
            number(SortSettings.DEFAULTS.iouGate()),
            "least overlap, 0 to 1, of a detection with the place where its track is expected; used where Association by (association) is overlap"),
    ASSOCIATION(
            "association",
            "Association by",
            word(SortSettings.DEFAULTS.association()),
            "how detections are joined: by how swimmers move, or by overlap with the predicted box as in the paper",
            choices(Association.values(), TrackOption::word)),
    INTERPOLATION(
            "interpolation",
            "Interpolation",
            word(SortSettings.DEFAULTS.interpolation()),
            "fill the gaps between detections, or as the paper's authors, with a tail after the last one",
            choices(Interpolation.values(), TrackOption::word)),
    SMOOTH(
            "smooth",
            "Smooth unsure positions",
            Kind.SWITCH,
            "true",
            "bring each point to where the way before and after it says, as far as its own position is unsure; off in the paper, and where Interpolation (interpolation) is authors"),
    PYTHON("python", "Python", Kind.TEXT, "", "interpreter to start the server with; found if left out"),
    SERVER("server", "Server (host:port)", Kind.TEXT, "", "a server that runs already; its token in MEMTRACK_TOKEN");

    /** What a value looks like. */
    public enum Kind {
        FOLDER,
        TEXT,
        NUMBER,
        INTEGER,
        CHOICE,
        SWITCH
    }

    private final String key;
    private final String label;
    private final Kind kind;
    private final String defaultValue;
    private final String help;
    private final Map<String, ?> choices;

    TrackOption(String key, String label, Kind kind, String defaultValue, String help) {
        this(key, label, kind, defaultValue, help, Map.of());
    }

    TrackOption(String key, String label, String defaultValue, String help, Map<String, ?> choices) {
        this(key, label, Kind.CHOICE, defaultValue, help, choices);
    }

    TrackOption(String key, String label, Kind kind, String defaultValue, String help, Map<String, ?> choices) {
        this.key = key;
        this.label = label;
        this.kind = kind;
        this.defaultValue = defaultValue;
        this.help = help;
        this.choices = choices;
    }

    /** Name in a macro. */
    public String key() {
        return key;
    }

    /** Name in the dialog. */
    public String label() {
        return label;
    }

    /** Both for messages, which users of the dialog and of macros get: "Least track length (min_length)". */
    public String bothNames() {
        return "%s (%s)".formatted(label.replaceFirst(" \\(.*\\)$", ""), key);
    }

    public Kind kind() {
        return kind;
    }

    /** What stands for it when a macro leaves it out; empty when something else decides. */
    public String defaultValue() {
        return defaultValue;
    }

    /** Meaning and unit, for manual and dialog. */
    public String help() {
        return help;
    }

    /** The values a {@code CHOICE} can have. */
    public List<String> choices() {
        return List.copyOf(choices.keySet());
    }

    /** What a choice stands for, its case aside; empty when there is no such choice. */
    Optional<Object> meaning(String choice) {
        return choices.entrySet().stream()
                .filter(entry -> entry.getKey().equalsIgnoreCase(choice))
                .findFirst()
                .map(Map.Entry::getValue);
    }

    /** Whether the first page of the dialog shows it. */
    public boolean common() {
        return compareTo(OVERLAY) <= 0;
    }

    private static String number(double value) {
        return value == Math.rint(value) ? Long.toString((long) value) : Double.toString(value);
    }

    private static <E> Map<String, E> choices(E[] meanings, Function<E, String> word) {
        Map<String, E> choices = new LinkedHashMap<>();
        for (E meaning : meanings) {
            choices.put(word.apply(meaning), meaning);
        }
        return choices;
    }

    private static String word(Enum<?> value) {
        return value.name().toLowerCase(Locale.ROOT).replace('_', ' ');
    }

    /** The option of that name; empty when there is none. */
    public static Optional<TrackOption> of(String key) {
        return Stream.of(values()).filter(option -> option.key.equals(key)).findFirst();
    }
}
