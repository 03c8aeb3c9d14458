// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import org.memtrack.tracking.Axis.Noise;

/**
 * How boxes move from frame to frame: variances in pixels^2 (area: pixels^4), velocities a frame.
 *
 * @param position of x and y
 * @param area of the area
 * @param aspect of the aspect; it has no velocity
 * @param persistence share of the velocity that is left after a frame, in (0, 1]
 * @param turning variance added to the velocity each frame, as a share of the squared speed
 * @param tumble probability of a tumble, a frame; 0 when the velocity never changes at once
 */
record MotionModel(Noise position, Noise area, Noise aspect, double persistence, double turning, double tumble) {
    /** The values published with SORT and used by the paper's authors. */
    static final MotionModel SORT = new MotionModel(
            new Noise(1, 10, 1e4, 1, 0.01), new Noise(10, 10, 1e4, 1, 0.0001), new Noise(10, 10, 0, 1, 0), 1, 0, 0);

    /**
     * Standard deviation of a swimmer's velocity, pixels a frame, before anything is known of the film; the best compromise
     * of 0.6 to 5 in worlds of mean speeds from 0.6 to 6 (TrackingBenchmark).
     */
    static final double USUAL_SPEED = 4;

    /** Share of a swimmer's velocity that is left after a frame. */
    static final double PERSISTENCE = 0.97;

    /** Error of a box's centre, as a share of the box's edge; never less than half a pixel. */
    private static final double CENTRE_ERROR = 1 / 30.0;

    /** Swimmers that run and tumble at a usual speed, in boxes of the given edge, pixels. */
    static MotionModel swimmers(double boxEdge) {
        return swimmers(boxEdge, USUAL_SPEED);
    }

    /**
     * Swimmers that run and tumble.
     *
     * @param boxEdge of their boxes, pixels
     * @param speed standard deviation of their velocity along an axis, pixels a frame
     */
    static MotionModel swimmers(double boxEdge, double speed) {
        double error = Math.max(0.5, CENTRE_ERROR * boxEdge);
        double variance = error * error;
        return new MotionModel(
                new Noise(variance, variance, speed * speed, 0.01, 0.005),
                SORT.area,
                SORT.aspect,
                PERSISTENCE,
                0.03,
                0.03);
    }
}
