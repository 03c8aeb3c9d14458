// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

import java.util.List;
import org.memtrack.detection.StageDrift;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;

/** Where a track was detected, in the scene's own coordinates: pixels of frame 0, the drift taken away. */
final class Trajectory {
    private final int[] frames;
    private final double[] xs;
    private final double[] ys;

    /** Interpolated points are left out, since their steps are not measured; a track of nothing else keeps them. */
    Trajectory(Track track, StageDrift drift) {
        List<TrackPoint> observed =
                track.points().stream().filter(point -> !point.interpolated()).toList();
        List<TrackPoint> points = observed.isEmpty() ? track.points() : observed;
        frames = points.stream().mapToInt(TrackPoint::frame).toArray();
        xs = points.stream()
                .mapToDouble(point -> point.box().centreX() - drift.x(point.frame()))
                .toArray();
        ys = points.stream()
                .mapToDouble(point -> point.box().centreY() - drift.y(point.frame()))
                .toArray();
    }

    /** Frames from the first point to the last. */
    int frameSpan() {
        return frames[frames.length - 1] - frames[0];
    }

    /** Length of the way along all points, pixels. */
    double length() {
        double length = 0;
        for (int i = 1; i < frames.length; i++) {
            length += Math.hypot(xs[i] - xs[i - 1], ys[i] - ys[i - 1]);
        }
        return length;
    }

    /** What is done with two points that lie a lag apart. */
    @FunctionalInterface
    interface Displacement {
        void accept(int lagFrames, double dx, double dy);
    }

    /** Visits every pair of points that lie at most so many frames apart. */
    void forEachDisplacement(int greatestLagFrames, Displacement displacement) {
        for (int i = 0; i < frames.length; i++) {
            for (int j = i + 1; j < frames.length && frames[j] - frames[i] <= greatestLagFrames; j++) {
                displacement.accept(frames[j] - frames[i], xs[j] - xs[i], ys[j] - ys[i]);
            }
        }
    }
}
