// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import org.memtrack.tracking.Axis.Noise;

/**
 * One coordinate of a whole track, each frame told from all detections before and after it: the Kalman filter forward, then
 * backward (Rauch, Tung and Striebel 1965).
 *
 * @param values in every frame from the first detection to the last
 * @param likelihood of what was measured, given its first value, as a logarithm and but for a constant
 */
record AxisSmoother(double[] values, double likelihood) {

    /**
     * Smooths one coordinate.
     *
     * @param frames where it was measured, in order
     * @param measured the values there
     * @param variances of their errors
     * @param noise of the motion, and of the first value
     */
    static AxisSmoother smooth(int[] frames, double[] measured, double[] variances, Noise noise) {
        int length = frames[frames.length - 1] - frames[0] + 1;
        Axis[] predicted = new Axis[length];
        Axis[] filtered = new Axis[length];
        predicted[0] = Axis.start(measured[0], noise);
        filtered[0] = predicted[0];
        int next = 1;
        double likelihood = 0;
        for (int i = 1; i < length; i++) {
            predicted[i] = filtered[i - 1].predict(MotionModel.PERSISTENCE, noise.step(), noise.velocityStep());
            filtered[i] = predicted[i];
            if (frames[next] - frames[0] == i) {
                filtered[i] = predicted[i].update(measured[next], noise.withMeasurement(variances[next]));
                double variance = predicted[i].variance() + variances[next];
                double surprise = measured[next] - predicted[i].value();
                likelihood -= (surprise * surprise / variance + Math.log(variance)) / 2;
                next++;
            }
        }
        double[] values = new double[length];
        Axis later = filtered[length - 1];
        values[length - 1] = later.value();
        for (int i = length - 2; i >= 0; i--) {
            later = back(filtered[i], predicted[i + 1], later);
            values[i] = later.value();
        }
        return new AxisSmoother(values, likelihood);
    }

    /** What is known of a frame once the next one is known; its variances are not needed and left as filtered. */
    private static Axis back(Axis filtered, Axis predictedNext, Axis next) {
        double persistence = MotionModel.PERSISTENCE;
        double determinant = predictedNext.variance() * predictedNext.velocityVariance()
                - predictedNext.covariance() * predictedNext.covariance();
        double valueError = next.value() - predictedNext.value();
        double velocityError = next.velocity() - predictedNext.velocity();
        // The errors, weighed by the inverse of the predicted covariance.
        double a = (predictedNext.velocityVariance() * valueError - predictedNext.covariance() * velocityError)
                / determinant;
        double b = (predictedNext.variance() * velocityError - predictedNext.covariance() * valueError) / determinant;
        return new Axis(
                filtered.value()
                        + (filtered.variance() + filtered.covariance()) * a
                        + persistence * filtered.covariance() * b,
                filtered.velocity()
                        + (filtered.covariance() + filtered.velocityVariance()) * a
                        + persistence * filtered.velocityVariance() * b,
                filtered.variance(),
                filtered.covariance(),
                filtered.velocityVariance());
    }
}
