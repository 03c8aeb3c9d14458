// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.math.BigDecimal;
import java.math.MathContext;
import java.util.List;
import java.util.OptionalDouble;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.StageDrift;
import org.memtrack.motility.MotilityAnalysis;
import org.memtrack.motility.TrackMotility;
import org.memtrack.tracking.Track;
import org.memtrack.video.FilmInfo;

/**
 * The result of a run: what the writers write.
 *
 * @param film the film
 * @param tracks its tracks
 * @param motility of each track, in the same order
 * @param drift of the scene, which the tracks are not freed of
 */
public record TrackedFilm(FilmInfo film, List<Track> tracks, List<TrackMotility> motility, StageDrift drift) {
    public TrackedFilm {
        tracks = List.copyOf(tracks);
        motility = List.copyOf(motility);
        if (tracks.size() != motility.size()) {
            throw new IllegalArgumentException(
                    "%d tracks but motility of %d".formatted(tracks.size(), motility.size()));
        }
    }

    /**
     * Tracks with their motility.
     *
     * @param frames what the detector said, for the drift of the scene; may be empty
     */
    public static TrackedFilm of(FilmInfo film, List<Track> tracks, List<FrameDetections> frames) {
        StageDrift drift = new StageDrift(frames);
        return new TrackedFilm(film, tracks, MotilityAnalysis.analyse(film, tracks, drift), drift);
    }

    /** What the lag speeds are taken over, for the user: a whole number of frames, in seconds where the film tells them. */
    public String speedLag() {
        if (motility.isEmpty()) {
            return "a lag";
        }
        int frames = motility.get(0).lagFrames();
        OptionalDouble interval = film.frameIntervalSeconds();
        return interval.isPresent()
                ? new BigDecimal(frames * interval.getAsDouble())
                                .round(new MathContext(3))
                                .stripTrailingZeros()
                                .toPlainString()
                        + " s"
                : frames + " frames";
    }
}
