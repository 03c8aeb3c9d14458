// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.memtrack.tracking.Axis.Noise;

/**
 * How much the contrast of a film's swimmers differs from one to the next, and how much it changes along a track. Swimmers
 * that meet look different more often than not: one is brighter, or nearer to the focal plane.
 *
 * @param noise of a measured contrast, and of its change from frame to frame
 * @param mean contrast of all swimmers
 * @param variance of the contrast of all swimmers
 */
record ContrastModel(Noise noise, double mean, double variance) {
    /** A contrast is one's own where no other swimmer is nearer than this, as a share of a box's edge. */
    static final double APART = 0.4;

    /** Frames after which the change along a track is measured. */
    private static final int LAG = 8;

    /** A film with fewer changes to measure tells nothing. */
    private static final int LEAST_CHANGES = 20;

    /** Variances, as a multiple of those of the typical change: some swimmers change more than that. */
    private static final double MARGIN = 2;

    /** Least variance of a measured contrast: it comes of 8 bits. */
    private static final double LEAST_VARIANCE = 1 / (127.0 * 127.0);

    /** How often a swimmer looks like any other, whatever it looked like before: as where two overlap. */
    private static final double SURPRISES = 0.1;

    /** Most that a contrast speaks for a match. */
    private static final double MOST = 3;

    /** Median of the square of a number of a normal distribution, as a share of its variance. */
    private static final double MEDIAN_OF_SQUARES = 0.4549;

    /** Told from what was joined without it; null where contrasts are not known or too few. */
    static @Nullable ContrastModel of(List<Tracklet> tracklets) {
        List<Double> atOnce = new ArrayList<>();
        List<Double> later = new ArrayList<>();
        double sum = 0;
        double squares = 0;
        int count = 0;
        for (Tracklet tracklet : tracklets) {
            List<TrackPoint> found = tracklet.points().stream()
                    .filter(point -> !point.interpolated())
                    .toList();
            addChanges(found, 1, atOnce);
            addChanges(found, LAG, later);
            for (TrackPoint point : found) {
                double contrast = point.detection().contrast();
                sum += contrast;
                squares += contrast * contrast;
                count++;
            }
        }
        if (Double.isNaN(sum) || atOnce.size() < LEAST_CHANGES || later.size() < LEAST_CHANGES) {
            return null;
        }
        double now = MARGIN * typical(atOnce);
        double then = Math.max(MARGIN * typical(later), now);
        double step = Math.max((then - now) / (LAG - 1), LEAST_VARIANCE / 1000);
        double measured = Math.max((now - step) / 2, LEAST_VARIANCE);
        double mean = sum / count;
        return new ContrastModel(new Noise(measured, measured, 0, step, 0), mean, squares / count - mean * mean);
    }

    /** Adds the squared changes of contrast between points that are so many frames apart. */
    private static void addChanges(List<TrackPoint> points, int lag, List<Double> changes) {
        int later = 0;
        for (TrackPoint point : points) {
            while (later < points.size() && points.get(later).frame() < point.frame() + lag) {
                later++;
            }
            if (later == points.size()) {
                return;
            }
            if (points.get(later).frame() == point.frame() + lag) {
                double change = points.get(later).detection().contrast()
                        - point.detection().contrast();
                changes.add(change * change);
            }
        }
    }

    private static double typical(List<Double> squares) {
        Collections.sort(squares);
        return squares.get(squares.size() / 2) / MEDIAN_OF_SQUARES;
    }

    /**
     * What a contrast says for a swimmer, against any of the film: the logarithm of how much likelier it is.
     *
     * @param known the swimmer's contrast, predicted to the frame
     */
    double gain(Axis known, double measured) {
        double own = density(measured - known.value(), known.variance() + noise.measurement());
        double any = density(measured - mean, variance + noise.measurement());
        return Math.min(MOST, Math.log((1 - SURPRISES) * own / Math.max(any, Double.MIN_NORMAL) + SURPRISES));
    }

    private static double density(double difference, double variance) {
        return Math.exp(-difference * difference / (2 * variance)) / Math.sqrt(2 * Math.PI * variance);
    }
}
