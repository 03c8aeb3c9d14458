// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.function.ToDoubleFunction;
import org.memtrack.detection.Box;
import org.memtrack.tracking.Axis.Noise;

/**
 * Fills the frames between the detections of a track: the centre where a swimmer most likely was, from its way before and
 * after the gap, the size on the straight line.
 */
public final class GapFilling {
    /** Lag over which a track's speed is measured, frames; less, and errors of position look like speed. */
    private static final int SPEED_LAG = 5;

    private GapFilling() {}

    /**
     * The points with those between them; the given ones are kept as they are.
     *
     * @param observed at least one, in order of frame
     */
    public static List<TrackPoint> fill(List<TrackPoint> observed) {
        TrackPoint first = observed.get(0);
        int length = observed.get(observed.size() - 1).frame() - first.frame() + 1;
        if (length == observed.size()) {
            return observed;
        }
        Noise noise = noiseOf(observed);
        double[] x = smooth(observed, Box::centreX, noise);
        double[] y = smooth(observed, Box::centreY, noise);
        List<TrackPoint> filled = new ArrayList<>(length);
        for (TrackPoint next : observed) {
            if (!filled.isEmpty()) {
                TrackPoint last = filled.get(filled.size() - 1);
                for (int frame = last.frame() + 1; frame < next.frame(); frame++) {
                    double share = (frame - last.frame()) / (double) (next.frame() - last.frame());
                    int i = frame - first.frame();
                    Box box = Box.around(
                            x[i],
                            y[i],
                            last.box().width()
                                    + share * (next.box().width() - last.box().width()),
                            last.box().height()
                                    + share * (next.box().height() - last.box().height()));
                    filled.add(new TrackPoint(frame, box, null));
                }
            }
            filled.add(next);
        }
        return filled;
    }

    private static double[] smooth(List<TrackPoint> observed, ToDoubleFunction<Box> coordinate, Noise noise) {
        int[] frames = observed.stream().mapToInt(TrackPoint::frame).toArray();
        double[] measured = observed.stream()
                .mapToDouble(point -> coordinate.applyAsDouble(point.box()))
                .toArray();
        double[] variances = new double[frames.length];
        Arrays.fill(variances, noise.measurement());
        return AxisSmoother.smooth(frames, measured, variances, noise).values();
    }

    /** Noise of a swimmer that turns the more the faster it is. */
    private static Noise noiseOf(List<TrackPoint> observed) {
        double edge = observed.stream()
                .mapToDouble(point -> Math.sqrt(point.box().area()))
                .average()
                .orElseThrow();
        MotionModel swimmers = MotionModel.swimmers(edge);
        Noise noise = swimmers.position();
        double speedSquared = speedSquared(observed, noise);
        return new Noise(
                noise.measurement(),
                noise.start(),
                noise.startVelocity(),
                noise.step(),
                noise.velocityStep() + swimmers.turning() * speedSquared);
    }

    /** Mean square of the speed, pixels^2 a frame^2; the model's start velocity for a track too short to tell. */
    private static double speedSquared(List<TrackPoint> observed, Noise noise) {
        double sum = 0;
        int count = 0;
        int later = 0;
        for (TrackPoint point : observed) {
            while (later < observed.size() && observed.get(later).frame() < point.frame() + SPEED_LAG) {
                later++;
            }
            if (later == observed.size()) {
                break;
            }
            TrackPoint other = observed.get(later);
            double lag = other.frame() - point.frame();
            double dx = other.box().centreX() - point.box().centreX();
            double dy = other.box().centreY() - point.box().centreY();
            sum += (dx * dx + dy * dy - 4 * noise.measurement()) / (lag * lag);
            count++;
        }
        return count == 0 ? noise.startVelocity() : Math.max(0, sum / count);
    }
}
