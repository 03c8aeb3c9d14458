// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;
import org.memtrack.detection.Box;

/** How fast the swimmers of a film are, told from their tracklets. */
final class SwimmerSpeed {
    /** Fewer detections are joined by chance too often. */
    private static final int LEAST_DETECTIONS = 3;

    /**
     * How much faster than the joined ones the swimmers are taken to be, since the fastest were not joined; 1 to 3 are even on
     * simulated films, of all frames and of every fourth one.
     */
    private static final double MARGIN = 1.5;

    private SwimmerSpeed() {}

    /** Standard deviation of the velocity along an axis, pixels a frame, with a margin; 0 when there is none to tell. */
    static double of(List<Tracklet> tracklets) {
        double squares = 0;
        int count = 0;
        for (Tracklet tracklet : tracklets) {
            List<TrackPoint> points = tracklet.points();
            for (int i = 1; i < points.size() && points.size() >= LEAST_DETECTIONS; i++) {
                Box before = points.get(i - 1).box();
                Box after = points.get(i).box();
                double frames = points.get(i).frame() - points.get(i - 1).frame();
                double x = (after.centreX() - before.centreX()) / frames;
                double y = (after.centreY() - before.centreY()) / frames;
                squares += x * x + y * y;
                count += 2;
            }
        }
        return count == 0 ? 0 : MARGIN * Math.sqrt(squares / count);
    }
}
