// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

/** How the thresholds of the levels were chosen on the validation films (paper section "False Positive Pruner"). */
public enum Criterion {
    /** A precision of at least 0.98. */
    MAXIMUM_PRECISION("maximum precision"),
    /** The lowest thresholds whose F1 is within 0.003 of the best. */
    MAXIMUM_F1("maximum F1");

    private final String label;

    Criterion(String label) {
        this.label = label;
    }

    /** Name in dialogs and macros. */
    public String label() {
        return label;
    }
}
