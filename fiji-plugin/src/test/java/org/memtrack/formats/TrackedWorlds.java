// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.testing.RandomWorld;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.SortTracker;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackFilter;
import org.memtrack.video.FilmInfo;

/** Tracked films to write and read back. */
final class TrackedWorlds {
    private TrackedWorlds() {}

    static TrackedFilm of(long seed, boolean calibrated, Interpolation interpolation) {
        return of(seed, calibrated, interpolation, 0);
    }

    /**
     * On a stage that drifts.
     *
     * @param drift of the scene, pixels a frame, to the right and half as much upwards
     */
    static TrackedFilm of(long seed, boolean calibrated, Interpolation interpolation, double drift) {
        RandomWorld world =
                RandomWorld.of(new RandomWorld.Settings(300, 200, 50, 15, 2, 0.05, 24, 0.8, 0.15, 0.03, 0.2, 2), seed);
        FilmInfo film = new FilmInfo(
                "Wässer <2> & \"Co\" 水\uD840\uDC0B",
                Optional.of(Path.of("a folder [1] ü 水", "film & <more> \uD840\uDC0B.tif")),
                300,
                200,
                50,
                calibrated ? OptionalDouble.of(0.2475) : OptionalDouble.empty(),
                calibrated ? OptionalDouble.of(1 / 60.0) : OptionalDouble.empty());
        SortSettings settings =
                new SortSettings(Association.MOTION, 0.05, 8, 0, interpolation, false, TrackFilter.ofLength(5));
        List<FrameDetections> frames = world.frames().stream()
                .map(frame -> drifted(frame, drift * frame.frame(), -drift * frame.frame() / 2))
                .toList();
        List<Track> tracks = new SortTracker(settings).track(frames);
        return TrackedFilm.of(film, tracks, frames);
    }

    private static FrameDetections drifted(FrameDetections frame, double x, double y) {
        List<Detection> moved = frame.detections().stream()
                .map(detection -> {
                    Box box = detection.box();
                    Box there = Box.around(box.centreX() + x, box.centreY() + y, box.width(), box.height());
                    return new Detection(
                            there,
                            detection.score(),
                            detection.level(),
                            detection.score() - 0.75,
                            1 - detection.score());
                })
                .toList();
        return new FrameDetections(frame.frame(), moved, x, y);
    }
}
