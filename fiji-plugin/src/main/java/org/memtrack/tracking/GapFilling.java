// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import org.memtrack.detection.Box;

/** Fills the frames between the detections of a track. */
final class GapFilling {
    private GapFilling() {}

    /** The points with the frames between them filled by boxes on the straight line. */
    static List<TrackPoint> fill(List<TrackPoint> observed) {
        List<TrackPoint> filled = new ArrayList<>();
        for (TrackPoint next : observed) {
            if (!filled.isEmpty()) {
                TrackPoint last = filled.get(filled.size() - 1);
                for (int frame = last.frame() + 1; frame < next.frame(); frame++) {
                    double share = (frame - last.frame()) / (double) (next.frame() - last.frame());
                    filled.add(new TrackPoint(frame, between(last.box(), next.box(), share), null));
                }
            }
            filled.add(next);
        }
        return filled;
    }

    private static Box between(Box from, Box to, double share) {
        return new Box(
                from.xMin() + share * (to.xMin() - from.xMin()),
                from.yMin() + share * (to.yMin() - from.yMin()),
                from.xMax() + share * (to.xMax() - from.xMax()),
                from.yMax() + share * (to.yMax() - from.yMax()));
    }
}
