// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

/** How it is decided which detection continues which track. */
public enum Association {
    /** By intersection over union of the detection with the box that SORT predicts, as in the paper. */
    OVERLAP,
    /**
     * By how likely a swimmer that runs and tumbles is at the place of the detection, against a new one or a false alarm
     * being there. The size of the boxes plays no part.
     */
    MOTION
}
