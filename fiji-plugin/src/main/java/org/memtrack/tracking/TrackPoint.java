// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import org.jspecify.annotations.Nullable;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;

/**
 * Where a track is in one frame.
 *
 * @param frame number of the frame, from 0
 * @param box where, in pixels
 * @param detection the detection it was observed as (the very object the tracker was given), or null when the point is
 *     interpolated
 */
public record TrackPoint(int frame, Box box, @Nullable Detection detection) {
    public TrackPoint {
        if (frame < 0) {
            throw new IllegalArgumentException("Frames are numbered from 0, not " + frame);
        }
    }

    /** Whether no detection stands behind this point. */
    public boolean interpolated() {
        return detection == null;
    }
}
