// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import org.memtrack.tracking.Axis.Noise;

/** How boxes move from frame to frame: variances in pixels^2 (area: pixels^4), velocities a frame. */
record MotionModel(Noise position, Noise area, Noise aspect) {
    /** The values published with SORT and used by the paper's authors; the aspect has no velocity. */
    static final MotionModel SORT = new MotionModel(
            new Noise(1, 10, 1e4, 1, 0.01), new Noise(10, 10, 1e4, 1, 0.0001), new Noise(10, 10, 0, 1, 0));
}
