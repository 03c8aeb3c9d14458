// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import ij.IJ;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.memtrack.client.DetectionSummary;
import org.memtrack.client.ModelInUse;
import org.memtrack.client.PluginVersion;
import org.memtrack.formats.Provenance;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;

/** Collects where the result of a run comes from. */
public final class Origin {
    /** Under what name the plug-in's version stands in every provenance. */
    static final String PLUGIN = "MEMTrack plug-in";

    /** The file that holds the film. */
    static final String FILE = "file";

    /** The file or folder that a film came from which is in no file as it is. */
    static final String OPENED_FROM = "opened_from";

    private Origin() {}

    /**
     * The provenance of a result.
     *
     * @param settings of the command, by key, enough to repeat the run
     * @param warnings what the user was told
     */
    public static Provenance of(Film film, TrackingResult result, Map<String, ?> settings, List<String> warnings) {
        return new Provenance(
                Instant.now().truncatedTo(ChronoUnit.SECONDS).toString(),
                software(result),
                film(film, result),
                model(result.detection().accepted()),
                new LinkedHashMap<>(settings),
                counts(result),
                result.detection().summary().secondsByStage(),
                warnings,
                Map.of());
    }

    private static Map<String, String> software(TrackingResult result) {
        Map<String, String> software = new LinkedHashMap<>();
        software.put(PLUGIN, PluginVersion.get());
        software.put("memtrack server", result.server().version());
        software.put("protocol", Integer.toString(result.server().protocol()));
        software.put("Python", result.server().pythonVersion());
        new TreeMap<>(result.server().libraries()).forEach(software::put);
        // Not ImageJ.VERSION, a constant: javac would put in that of the ImageJ which the plug-in is compiled against.
        software.put("ImageJ", IJ.getVersion());
        software.put("Java", System.getProperty("java.version", ""));
        software.put("system", System.getProperty("os.name", "") + " " + System.getProperty("os.arch", ""));
        return software;
    }

    private static Map<String, Object> film(Film film, TrackingResult result) {
        FilmInfo info = film.info();
        Map<String, Object> values = new LinkedHashMap<>();
        values.put("title", info.title());
        film.openedFrom()
                .ifPresent(place -> values.put(info.file().isPresent() ? FILE : OPENED_FROM, place.toString()));
        values.put("sha256", result.detection().summary().filmSha256());
        values.put("width", info.width());
        values.put("height", info.height());
        values.put("frames", info.frameCount());
        values.put("first_frame", film.firstFrame());
        // Other than the option first_frame of the settings.
        values.put("frames_count_from", 0);
        values.put("samples", film.sampleType().name());
        info.pixelSizeMicrometres().ifPresent(size -> values.put("pixel_size_um", size));
        info.frameIntervalSeconds().ifPresent(interval -> values.put("frame_interval_s", interval));
        return values;
    }

    private static Map<String, Object> model(ModelInUse model) {
        Map<String, Object> values = new LinkedHashMap<>();
        values.put("name", model.name());
        values.put("version", model.version());
        values.put("sha256", model.sha256());
        values.put("engine", model.engine());
        values.put("scale", model.scale());
        values.put("threshold_low", model.thresholds().low());
        values.put("threshold_medium", model.thresholds().medium());
        values.put("threshold_high", model.thresholds().high());
        return values;
    }

    private static Map<String, Long> counts(TrackingResult result) {
        DetectionSummary summary = result.detection().summary();
        List<Track> tracks = result.tracked().tracks();
        Map<String, Long> counts = new LinkedHashMap<>();
        counts.put("candidates", summary.candidates());
        counts.put("too_large", summary.tooLarge());
        counts.put("near_misses", summary.nearMisses());
        counts.put("overlapping", summary.overlapping());
        counts.put("outside_region", summary.outsideRegion());
        counts.put("detections", summary.kept());
        counts.put("dropped_tracks", (long) result.droppedTracks());
        counts.put("tracks", (long) tracks.size());
        counts.put(
                "points",
                tracks.stream().mapToLong(track -> track.points().size()).sum());
        counts.put(
                "interpolated_points",
                tracks.stream()
                        .flatMap(track -> track.points().stream())
                        .filter(TrackPoint::interpolated)
                        .count());
        return counts;
    }
}
