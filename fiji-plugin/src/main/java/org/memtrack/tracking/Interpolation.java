// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

/** What stands in a track where no detection was found. */
public enum Interpolation {
    /**
     * The frames between two detections of a track are filled from both sides; nothing follows its last detection.
     * Observed points keep the box of their detection, or are smoothed ({@link SortSettings#smooth}).
     */
    FILL_GAPS,
    /**
     * The predictions of the Kalman filter, for up to the maximum age and also after the last detection; observed points
     * are the filter's estimate. What the paper's authors do.
     */
    AUTHORS
}
