// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.detection;

import java.util.List;

/**
 * What was found in one frame.
 *
 * @param frame number of the frame, from 0
 * @param detections in any order
 * @param driftX how far the scene stands right of its place in frame 0, in pixels; boxes are not corrected by it
 * @param driftY how far the scene stands below its place in frame 0, in pixels
 * @param faint boxes that only their score keeps from being detections; none where the detector does not tell them
 */
public record FrameDetections(
        int frame, List<Detection> detections, double driftX, double driftY, List<Detection> faint) {
    public FrameDetections {
        if (frame < 0) {
            throw new IllegalArgumentException("Frames are numbered from 0, not " + frame);
        }
        detections = List.copyOf(detections);
        faint = List.copyOf(faint);
    }

    /** Detections of a frame, and none that are faint. */
    public FrameDetections(int frame, List<Detection> detections, double driftX, double driftY) {
        this(frame, detections, driftX, driftY, List.of());
    }

    /** Detections of a frame whose scene does not drift. */
    public FrameDetections(int frame, List<Detection> detections) {
        this(frame, detections, 0, 0);
    }
}
