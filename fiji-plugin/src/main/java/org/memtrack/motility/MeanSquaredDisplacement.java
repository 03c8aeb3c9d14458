// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

/**
 * Mean squared displacement of a track over each lag.
 *
 * @param greatestLagFrames greatest lag, frames
 * @param sums sum of the squared displacements of each lag, pixels^2; index 0 is not used
 * @param counts pairs of points of each lag
 */
record MeanSquaredDisplacement(int greatestLagFrames, double[] sums, int[] counts) {

    static MeanSquaredDisplacement of(Trajectory trajectory, int greatestLagFrames) {
        double[] sums = new double[greatestLagFrames + 1];
        int[] counts = new int[greatestLagFrames + 1];
        trajectory.forEachDisplacement(greatestLagFrames, (lag, dx, dy) -> {
            sums[lag] += dx * dx + dy * dy;
            counts[lag]++;
        });
        return new MeanSquaredDisplacement(greatestLagFrames, sums, counts);
    }

    boolean has(int lagFrames) {
        return lagFrames <= greatestLagFrames && counts[lagFrames] > 0;
    }

    /** Mean squared displacement over a lag that {@link #has a pair of points}, pixels^2. */
    double at(int lagFrames) {
        return sums[lagFrames] / counts[lagFrames];
    }

    /**
     * What errors of position add to every lag, pixels^2: the straight line through the first two lags, carried on to lag
     * 0; never negative, and 0 where the two lags are not known.
     */
    double floor() {
        return has(1) && has(2) ? Math.max(0, 2 * at(1) - at(2)) : 0;
    }
}
