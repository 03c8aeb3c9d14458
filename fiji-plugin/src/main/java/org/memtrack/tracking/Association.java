// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

/** How it is decided which detection continues which track. */
public enum Association {
    /** By intersection over union of the detection with the predicted box, as in the paper. */
    OVERLAP,
    /** By the distance from the predicted centre, measured in the prediction's own uncertainty. */
    MOTION
}
