// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import org.memtrack.client.DetectionSettings;
import org.memtrack.server.ServerSettings;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.SortTracker;

/**
 * All that is set for one run.
 *
 * @param detection how to detect
 * @param tracking how to join detections into tracks, the least length of a track among it
 * @param server where the detection server comes from
 * @param secondLook whether faint cells are looked for among what the thresholds drop, see {@link SortTracker}
 */
public record TrackingSettings(
        DetectionSettings detection, SortSettings tracking, ServerSettings server, boolean secondLook) {
    /** The same settings, detecting in another way. */
    public TrackingSettings with(DetectionSettings newDetection) {
        return new TrackingSettings(newDetection, tracking, server, secondLook);
    }

    /** The same settings, joining detections in another way. */
    public TrackingSettings with(SortSettings newTracking) {
        return new TrackingSettings(detection, newTracking, server, secondLook);
    }
}
