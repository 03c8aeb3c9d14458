// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import java.util.function.ToDoubleFunction;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.tracking.Axis.Noise;

/**
 * Brings each point of a track to where its swimmer most likely was: by its own detection as far as that is sure of its
 * place, by the way before and after it as far as it is not. Not a part of the paper.
 *
 * <p>How steadily a swimmer swims is not known beforehand. So its way is smoothed for swimmers of many kinds, from those that
 * go straight on to those that only wander, and the mean is taken, each weighted by how likely it makes the detections.
 */
final class Smoothing {
    /** What a swimmer's velocity may change by in a frame: variances, pixels^2 a frame^2, in boxes of 30 pixels. */
    private static final double[] VELOCITY_STEPS = {1e-4, 1e-3, 0.01, 0.1, 1, 10};

    /** How far it may be displaced besides in a frame: variances, pixels^2, in boxes of 30 pixels. */
    private static final double[] STEPS = {1e-4, 1e-3, 0.01, 0.1, 1};

    private static final double USUAL_EDGE = 30;

    /**
     * Share of a detection's error that differs from one frame to the next. The rest, which a halo or the focus makes, stays
     * for many frames, and cannot be told from the swimmer's own motion: smoothed as if it could, slow swimmers seem slower.
     */
    private static final double VARYING = 0.3;

    /** A way, frame by frame, and how likely it makes the detections, as a logarithm. */
    private record Way(double[] x, double[] y, double likelihood) {}

    private Smoothing() {}

    /**
     * The points, brought to where their swimmer most likely was; as they are where a detection does not tell its error.
     *
     * @param points of every frame from the first detection to the last
     */
    static List<TrackPoint> smooth(List<TrackPoint> points) {
        List<TrackPoint> found =
                points.stream().filter(point -> !point.interpolated()).toList();
        if (found.stream().anyMatch(point -> Double.isNaN(point.detection().error()))) {
            return points;
        }
        Way way = mean(ways(found));
        List<TrackPoint> smooth = new ArrayList<>(points.size());
        for (int i = 0; i < points.size(); i++) {
            TrackPoint point = points.get(i);
            Box box = Box.around(
                    way.x[i], way.y[i], point.box().width(), point.box().height());
            smooth.add(new TrackPoint(point.frame(), box, point.detection()));
        }
        return smooth;
    }

    private static List<Way> ways(List<TrackPoint> found) {
        int[] frames = found.stream().mapToInt(TrackPoint::frame).toArray();
        double[] x = ofEach(found, detection -> detection.box().centreX());
        double[] y = ofEach(found, detection -> detection.box().centreY());
        double[] variances = ofEach(found, detection -> square(VARYING * detection.error()));
        double unit = square(Math.sqrt(found.get(0).box().area()) / USUAL_EDGE);
        double speed = square(MotionModel.USUAL_SPEED);
        List<Way> ways = new ArrayList<>();
        for (double step : STEPS) {
            for (double velocityStep : VELOCITY_STEPS) {
                Noise noise = new Noise(variances[0], variances[0], speed, unit * step, unit * velocityStep);
                AxisSmoother alongX = AxisSmoother.smooth(frames, x, variances, noise);
                AxisSmoother alongY = AxisSmoother.smooth(frames, y, variances, noise);
                ways.add(new Way(alongX.values(), alongY.values(), alongX.likelihood() + alongY.likelihood()));
            }
        }
        return ways;
    }

    private static Way mean(List<Way> ways) {
        double best = ways.stream().mapToDouble(Way::likelihood).max().orElseThrow();
        double sum = ways.stream()
                .mapToDouble(way -> Math.exp(way.likelihood - best))
                .sum();
        int length = ways.get(0).x.length;
        Way mean = new Way(new double[length], new double[length], best);
        for (Way way : ways) {
            double weight = Math.exp(way.likelihood - best) / sum;
            for (int i = 0; i < length; i++) {
                mean.x[i] += weight * way.x[i];
                mean.y[i] += weight * way.y[i];
            }
        }
        return mean;
    }

    private static double[] ofEach(List<TrackPoint> found, ToDoubleFunction<Detection> value) {
        return found.stream()
                .mapToDouble(point -> value.applyAsDouble(point.detection()))
                .toArray();
    }

    private static double square(double value) {
        return value * value;
    }
}
