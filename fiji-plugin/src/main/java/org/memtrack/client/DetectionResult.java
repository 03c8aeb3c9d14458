// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.util.List;
import java.util.stream.Stream;
import org.memtrack.detection.FrameDetections;

/**
 * What was found in a film.
 *
 * @param frames one entry a frame, in order, from frame 0 of the film
 * @param summary what was kept and what was dropped
 * @param accepted what the server worked with
 */
public record DetectionResult(List<FrameDetections> frames, DetectionSummary summary, ModelInUse accepted) {
    public DetectionResult {
        frames = List.copyOf(frames);
    }

    /** What the user should know about the film and the settings, one sentence each. */
    public List<String> warnings() {
        return Stream.concat(accepted.warnings().stream(), summary.warnings().stream())
                .toList();
    }
}
