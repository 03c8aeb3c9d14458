// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

import java.util.List;
import java.util.Map;
import java.util.NavigableMap;
import java.util.TreeMap;
import org.memtrack.detection.FrameDetections;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;

/** Where a track was detected, in the scene's own coordinates: pixels of frame 0, the drift taken away. */
final class Trajectory {
    /** Where the drift of each frame is looked up. */
    record Drift(NavigableMap<Integer, FrameDetections> frames) {
        static Drift of(List<FrameDetections> frames) {
            NavigableMap<Integer, FrameDetections> byFrame = new TreeMap<>();
            frames.forEach(frame -> byFrame.put(frame.frame(), frame));
            return new Drift(byFrame);
        }

        private FrameDetections at(int frame) {
            Map.Entry<Integer, FrameDetections> entry = frames.floorEntry(frame);
            return entry == null ? new FrameDetections(frame, List.of()) : entry.getValue();
        }
    }

    private final int[] frames;
    private final double[] xs;
    private final double[] ys;

    /** Interpolated points are left out, since their steps are not measured; a track of nothing else keeps them. */
    Trajectory(Track track, Drift drift) {
        List<TrackPoint> observed =
                track.points().stream().filter(point -> !point.interpolated()).toList();
        List<TrackPoint> points = observed.isEmpty() ? track.points() : observed;
        frames = points.stream().mapToInt(TrackPoint::frame).toArray();
        xs = points.stream()
                .mapToDouble(
                        point -> point.box().centreX() - drift.at(point.frame()).driftX())
                .toArray();
        ys = points.stream()
                .mapToDouble(
                        point -> point.box().centreY() - drift.at(point.frame()).driftY())
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
