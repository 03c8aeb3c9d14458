// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

/**
 * Lowest score kept, one a level.
 *
 * @param low for the low level, in [0, 1]
 * @param medium for the medium level, in [0, 1]
 * @param high for the high level, in [0, 1]
 */
public record Thresholds(double low, double medium, double high) {
    public Thresholds {
        check("low", low);
        check("medium", medium);
        check("high", high);
    }

    private static void check(String level, double threshold) {
        if (!(threshold >= 0 && threshold <= 1)) {
            throw new IllegalArgumentException(
                    "The threshold of the %s level must lie in 0 to 1, not %s".formatted(level, threshold));
        }
    }
}
