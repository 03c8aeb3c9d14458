// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import org.memtrack.client.DetectionSettings;
import org.memtrack.server.ServerSettings;
import org.memtrack.tracking.SortSettings;

/**
 * All that is set for one run.
 *
 * @param detection how to detect
 * @param tracking how to join detections into tracks, the least length of a track among it
 * @param server where the detection server comes from
 */
public record TrackingSettings(DetectionSettings detection, SortSettings tracking, ServerSettings server) {
    public static final TrackingSettings DEFAULTS =
            new TrackingSettings(DetectionSettings.DEFAULTS, SortSettings.DEFAULTS, ServerSettings.DEFAULTS);
}
