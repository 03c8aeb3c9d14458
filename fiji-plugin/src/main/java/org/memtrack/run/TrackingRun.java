// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.util.ArrayList;
import java.util.List;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.server.ServerConnection;
import org.memtrack.server.Servers;
import org.memtrack.tracking.Field;
import org.memtrack.tracking.FilteredTracks;
import org.memtrack.tracking.SortTracker;
import org.memtrack.tracking.TrackFilter;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;

/** One run: film, detections, tracks, motility. */
public final class TrackingRun {
    private static final double DETECTED = 0.97;

    private TrackingRun() {}

    /**
     * Tracks a film.
     *
     * @param film read once, the last frame twice
     * @param settings what with
     * @param progress told where the run stands, asked whether to go on
     * @throws DetectorException when there is no server, or it refuses or fails
     * @throws CancellationException when progress was cancelled
     */
    public static TrackingResult run(Film film, TrackingSettings settings, Progress progress) {
        try (ServerConnection connection = Servers.acquire(settings.server(), progress)) {
            DetectionResult detection = connection.detect(film, settings.detection(), progress.between(0, DETECTED));
            FilmInfo info = wholeFilm(film);
            Progress rest = progress.between(DETECTED, 1);
            List<FrameDetections> frames = asTracked(detection.frames(), film.firstFrame(), settings.secondLook());
            FilteredTracks found = new SortTracker(settings.tracking(), new Field(info.width(), info.height()))
                    .trackAndFilter(
                            frames,
                            fraction -> rest.report("Tracking", fraction, OptionalDouble.empty(), ""),
                            progress::cancelled);
            TrackedFilm tracked = TrackedFilm.of(info, found.tracks(), frames);
            List<String> warnings = new ArrayList<>(connection.warnings());
            warnings.addAll(detection.warnings());
            if (found.tracks().isEmpty()) {
                warnings.add(noTracks(detection.summary().kept(), settings));
            }
            return new TrackingResult(tracked, found.dropped(), detection, connection.info(), warnings);
        }
    }

    /** Options are told by the name of their field in the dialog and, in brackets, by that in a macro. */
    static String noTracks(long detections, TrackingSettings settings) {
        if (detections > 0) {
            TrackFilter filter = settings.tracking().filter();
            return "No track is as long as %d frames and as sure as %s: lower Least track length (min_length) or Least track score (min_score)."
                    .formatted(filter.minimumLength(), filter.minimumScore());
        }
        DetectionSettings detection = settings.detection();
        boolean strict = detection.thresholds() == null && detection.criterion() == Criterion.MAXIMUM_PRECISION;
        return "Nothing was detected: %s, or check that Pixel size (pixel_size), Cell length (cell_length) and Model (model) fit the film."
                .formatted(
                        strict
                                ? "choose maximum F1 in Thresholds for (criterion)"
                                : "lower the thresholds of the levels (threshold_low, threshold_medium, threshold_high)");
    }

    /** Numbered as in the image, and without faint boxes where no second look is wanted. */
    private static List<FrameDetections> asTracked(List<FrameDetections> frames, int firstFrame, boolean faint) {
        return frames.stream()
                .map(frame -> new FrameDetections(
                        frame.frame() + firstFrame,
                        frame.detections(),
                        frame.driftX(),
                        frame.driftY(),
                        faint ? frame.faint() : List.of()))
                .toList();
    }

    private static FilmInfo wholeFilm(Film film) {
        FilmInfo info = film.info();
        return new FilmInfo(
                info.title(),
                info.file(),
                info.width(),
                info.height(),
                film.firstFrame() + info.frameCount(),
                info.pixelSizeMicrometres(),
                info.frameIntervalSeconds());
    }
}
