// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * What is known of a film's swimmers.
 *
 * @param edge typical edge of their boxes, pixels
 * @param motion how they move
 * @param contrast how they look; null when nothing is known of it
 */
record SwimmerModel(
        double edge, MotionModel motion, @Nullable ContrastModel contrast) {
    /** Before anything was joined. */
    static SwimmerModel usual(double edge) {
        return new SwimmerModel(edge, MotionModel.swimmers(edge), null);
    }

    /** Told from what was joined; swimmers that are slower than usual are taken for usual ones. */
    static SwimmerModel of(List<Tracklet> tracklets, double edge) {
        double speed = Math.max(Math.min(SwimmerSpeed.of(tracklets), edge), MotionModel.USUAL_SPEED);
        return new SwimmerModel(edge, MotionModel.swimmers(edge, speed), ContrastModel.of(tracklets));
    }
}
