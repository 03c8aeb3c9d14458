// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

/**
 * One coordinate of a box and its velocity, as a constant-velocity Kalman filter knows them.
 *
 * <p>In SORT's model no noise and no motion couples x, y, area and aspect, so its filter of seven numbers is exactly four
 * of these.
 *
 * @param value estimate of the coordinate
 * @param velocity estimate of its change a frame
 * @param variance of the value
 * @param covariance of value and velocity
 * @param velocityVariance of the velocity
 */
record Axis(double value, double velocity, double variance, double covariance, double velocityVariance) {

    /**
     * Variances of one axis.
     *
     * @param measurement of a measured value
     * @param start of the value when a track begins
     * @param startVelocity of the velocity when a track begins; 0 when the value has none
     * @param step added to the value each frame
     * @param velocityStep added to the velocity each frame
     */
    record Noise(double measurement, double start, double startVelocity, double step, double velocityStep) {
        Noise withMeasurement(double variance) {
            return new Noise(variance, start, startVelocity, step, velocityStep);
        }
    }

    static Axis start(double measured, Noise noise) {
        return new Axis(measured, 0, noise.start, 0, noise.startVelocity);
    }

    /** One frame later, at a velocity that stays the same but for noise. */
    Axis predict(Noise noise) {
        return predict(1, noise.step, noise.velocityStep);
    }

    /**
     * One frame later.
     *
     * @param persistence share of the velocity that is left after the frame
     * @param step variance added to the value
     * @param velocityStep variance added to the velocity
     */
    Axis predict(double persistence, double step, double velocityStep) {
        return new Axis(
                value + velocity,
                persistence * velocity,
                variance + 2 * covariance + velocityVariance + step,
                persistence * (covariance + velocityVariance),
                persistence * persistence * velocityVariance + velocityStep);
    }

    /** Corrected by a measured value. */
    Axis update(double measured, Noise noise) {
        double gain = variance / (variance + noise.measurement);
        double velocityGain = covariance / (variance + noise.measurement);
        double residual = measured - value;
        return new Axis(
                value + gain * residual,
                velocity + velocityGain * residual,
                variance * (1 - gain),
                covariance * (1 - gain),
                velocityVariance - velocityGain * covariance);
    }

    Axis withoutVelocity() {
        return new Axis(value, 0, variance, covariance, velocityVariance);
    }
}
