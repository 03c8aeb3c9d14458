// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.util.List;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.ServerInfo;
import org.memtrack.formats.TrackedFilm;

/**
 * What a run found.
 *
 * @param tracked film, tracks and their motility; frames are numbered as in the image, also when only a part was tracked
 * @param droppedTracks tracks of detections that the track filter dropped
 * @param detection what the server answered
 * @param server what the server said of itself
 * @param warnings what the user should know, one sentence each
 */
public record TrackingResult(
        TrackedFilm tracked, int droppedTracks, DetectionResult detection, ServerInfo server, List<String> warnings) {
    public TrackingResult {
        warnings = List.copyOf(warnings);
    }

    /** One sentence on what was found; a zero tells what lower thresholds would have let through. */
    public String describe() {
        int tracks = tracked.tracks().size();
        return "%d %s from %s."
                .formatted(
                        tracks,
                        tracks == 1 ? "track" : "tracks",
                        detection.summary().describe(detection.accepted().thresholds()));
    }
}
