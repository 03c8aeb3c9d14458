// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.util.ArrayList;
import java.util.List;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.server.ServerConnection;
import org.memtrack.server.Servers;
import org.memtrack.tracking.Field;
import org.memtrack.tracking.SortTracker;
import org.memtrack.tracking.Track;
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
            List<Track> tracks = new SortTracker(settings.tracking(), new Field(info.width(), info.height()))
                    .track(
                            frames,
                            fraction -> rest.report("Tracking", fraction, OptionalDouble.empty(), ""),
                            progress::cancelled);
            TrackedFilm tracked = TrackedFilm.of(info, tracks, frames);
            List<String> warnings = new ArrayList<>(detection.accepted().warnings());
            if (tracks.isEmpty()) {
                warnings.add(noTracks(detection, settings));
            }
            return new TrackingResult(tracked, frames, detection, connection.info(), warnings);
        }
    }

    private static String noTracks(DetectionResult detection, TrackingSettings settings) {
        return detection.summary().kept() == 0
                ? "Nothing was detected: lower the thresholds, choose maximum F1, or check that the model fits the film."
                : "No track is as long as %d frames and as sure as %s: lower min_length or min_score."
                        .formatted(
                                settings.tracking().filter().minimumLength(),
                                settings.tracking().filter().minimumScore());
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
