// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

import java.util.List;
import java.util.OptionalDouble;
import java.util.stream.IntStream;
import org.memtrack.detection.StageDrift;
import org.memtrack.tracking.Track;
import org.memtrack.video.FilmInfo;

/** Motility of the tracks of a film (paper section "Determining Track Length and Motion Characteristics"). */
public final class MotilityAnalysis {
    /** Lag of the lag speed, seconds; long enough that errors of position matter little, shorter than a run. */
    public static final double SPEED_LAG_SECONDS = 0.1;

    /** Lag of the lag speed where the frame interval is not known, frames: 0.1 s at the paper's 60 frames/s. */
    private static final int SPEED_LAG_FRAMES = 6;

    /** Greatest lag of the diffusivity, seconds (paper equation for D(tau)). */
    private static final double GREATEST_LAG_SECONDS = 2.5;

    private MotilityAnalysis() {}

    /**
     * Motility of each track, in the order of the tracks.
     *
     * @param film whose calibration is used
     * @param tracks boxes in the coordinates of the raw film
     * @param drift of the scene, which is taken away
     */
    public static List<TrackMotility> analyse(FilmInfo film, List<Track> tracks, StageDrift drift) {
        return tracks.stream()
                .map(track -> analyse(film, track.id(), new Trajectory(track, drift)))
                .toList();
    }

    private static TrackMotility analyse(FilmInfo film, int trackId, Trajectory trajectory) {
        OptionalDouble speed = trajectory.frameSpan() == 0
                ? OptionalDouble.empty()
                : OptionalDouble.of(trajectory.length() / trajectory.frameSpan());
        int lag = film.frameIntervalSeconds().isPresent()
                ? framesIn(SPEED_LAG_SECONDS, film.frameIntervalSeconds().getAsDouble())
                : SPEED_LAG_FRAMES;
        OptionalDouble lagSpeed = lagSpeed(trajectory, lag);
        OptionalDouble diffusivity = film.calibrated()
                ? peakDiffusivity(
                        trajectory,
                        film.pixelSizeMicrometres().getAsDouble(),
                        film.frameIntervalSeconds().getAsDouble())
                : OptionalDouble.empty();
        return new TrackMotility(
                trackId,
                speed,
                lag,
                lagSpeed,
                calibrated(film, speed),
                calibrated(film, lagSpeed),
                diffusivity,
                diffusivity.stream().mapToObj(MotilityClass::of).findFirst());
    }

    private static OptionalDouble lagSpeed(Trajectory trajectory, int lagFrames) {
        double[] sum = new double[2];
        trajectory.forEachDisplacement(lagFrames, (lag, dx, dy) -> {
            if (lag == lagFrames) {
                sum[0] += Math.hypot(dx, dy) / lag;
                sum[1]++;
            }
        });
        return sum[1] == 0 ? OptionalDouble.empty() : OptionalDouble.of(sum[0] / sum[1]);
    }

    /**
     * Greatest (MSD(tau) - floor) / (4 tau), um^2/s, over lags from 0.1 s to the least of 2.5 s and half the track.
     *
     * <p>The paper starts at a lag of one frame and takes nothing away. There, 0.3 px of error in the position of a
     * bacterium that does not move would make it "medium" at 60 frames/s.
     */
    static OptionalDouble peakDiffusivity(Trajectory trajectory, double pixelSizeMicrometres, double intervalSeconds) {
        int greatestLag = Math.min(framesIn(GREATEST_LAG_SECONDS, intervalSeconds), trajectory.frameSpan() / 2);
        if (greatestLag < 1) {
            return OptionalDouble.empty();
        }
        int leastLag = Math.min(framesIn(SPEED_LAG_SECONDS, intervalSeconds), greatestLag);
        MeanSquaredDisplacement displacement = MeanSquaredDisplacement.of(trajectory, Math.max(greatestLag, 2));
        double floor = displacement.floor();
        return IntStream.rangeClosed(leastLag, greatestLag)
                .filter(displacement::has)
                .mapToDouble(lag -> Math.max(0, displacement.at(lag) - floor) / (4 * lag * intervalSeconds))
                .map(pixels -> pixels * pixelSizeMicrometres * pixelSizeMicrometres)
                .max();
    }

    private static int framesIn(double seconds, double intervalSeconds) {
        return (int) Math.max(1, Math.min(Integer.MAX_VALUE - 1, Math.round(seconds / intervalSeconds)));
    }

    private static OptionalDouble calibrated(FilmInfo film, OptionalDouble pixelsPerFrame) {
        if (!film.calibrated() || pixelsPerFrame.isEmpty()) {
            return OptionalDouble.empty();
        }
        return OptionalDouble.of(pixelsPerFrame.getAsDouble()
                * film.pixelSizeMicrometres().getAsDouble()
                / film.frameIntervalSeconds().getAsDouble());
    }
}
