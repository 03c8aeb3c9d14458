// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;
import org.memtrack.detection.Detection;
import org.memtrack.tracking.Matching.Pair;

/** Decides which detection of a frame continues which tracklet. */
interface Associator {
    /**
     * Matches by the indices of their tracklet and detection, no index twice.
     *
     * @param tracklets predicted to the frame of the detections
     */
    List<Pair> match(List<Tracklet> tracklets, List<Detection> detections);
}
