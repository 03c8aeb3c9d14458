// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

/** Class of motility of a track, by its peak diffusivity (paper section "Motility"). */
public enum MotilityClass {
    /** At most 0.075 um^2/s. */
    NONE(0.075),
    /** At most 0.25 um^2/s. */
    LOW(0.25),
    /** At most 1 um^2/s. */
    MEDIUM(1),
    /** More than 1 um^2/s. */
    HIGH(Double.POSITIVE_INFINITY);

    private final double greatestDiffusivity;

    MotilityClass(double greatestDiffusivity) {
        this.greatestDiffusivity = greatestDiffusivity;
    }

    /** The class of a peak diffusivity, um^2/s, not negative. */
    public static MotilityClass of(double peakDiffusivity) {
        if (!(peakDiffusivity >= 0)) {
            throw new IllegalArgumentException("A diffusivity is not negative: " + peakDiffusivity);
        }
        for (MotilityClass motilityClass : values()) {
            if (peakDiffusivity <= motilityClass.greatestDiffusivity) {
                return motilityClass;
            }
        }
        throw new AssertionError(peakDiffusivity);
    }
}
