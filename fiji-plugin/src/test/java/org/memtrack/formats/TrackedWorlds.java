// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
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
    /** Tracks with their film and the detections they were made from. */
    record TrackedWorld(TrackedFilm tracked, List<FrameDetections> detections) {}

    private TrackedWorlds() {}

    static TrackedWorld of(long seed, boolean calibrated, Interpolation interpolation) {
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
                new SortSettings(Association.MOTION, 0.05, 8, 0, interpolation, TrackFilter.ofLength(5));
        List<Track> tracks = new SortTracker(settings).track(world.frames());
        return new TrackedWorld(TrackedFilm.of(film, tracks, world.frames()), world.frames());
    }
}
