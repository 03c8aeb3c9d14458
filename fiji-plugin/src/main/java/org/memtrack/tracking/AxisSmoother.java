// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import org.memtrack.tracking.Axis.Noise;

/**
 * One coordinate of a whole track, each frame told from all detections before and after it: the Kalman filter forward, then
 * backward (Rauch, Tung and Striebel 1965).
 */
final class AxisSmoother {
    private AxisSmoother() {}

    /**
     * The value in every frame from the first to the last.
     *
     * @param frames where it was measured, in order
     * @param measured the values there
     * @param persistence share of the velocity that is left after a frame
     */
    static double[] smooth(int[] frames, double[] measured, Noise noise, double persistence) {
        int length = frames[frames.length - 1] - frames[0] + 1;
        Axis[] predicted = new Axis[length];
        Axis[] filtered = new Axis[length];
        int next = 0;
        for (int i = 0; i < length; i++) {
            predicted[i] = i == 0
                    ? Axis.start(measured[0], noise)
                    : filtered[i - 1].predict(persistence, noise.step(), noise.velocityStep());
            filtered[i] = predicted[i];
            if (frames[next] - frames[0] == i) {
                filtered[i] = i == 0 ? predicted[i] : predicted[i].update(measured[next], noise);
                next++;
            }
        }
        double[] values = new double[length];
        Axis later = filtered[length - 1];
        values[length - 1] = later.value();
        for (int i = length - 2; i >= 0; i--) {
            later = back(filtered[i], predicted[i + 1], later, persistence);
            values[i] = later.value();
        }
        return values;
    }

    /** What is known of a frame once the next one is known; its variances are not needed and left as filtered. */
    private static Axis back(Axis filtered, Axis predictedNext, Axis next, double persistence) {
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
