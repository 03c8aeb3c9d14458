// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Map;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.StageDrift;

/**
 * Detections in coordinates of the scene while they are joined, and tracks back in those of the film: bacteria move with
 * respect to the scene, and a stage that jumps would break every track.
 */
final class SceneView {
    private final StageDrift drift;
    private final boolean still;
    private final Map<Detection, Detection> found = new IdentityHashMap<>();

    SceneView(StageDrift drift) {
        this.drift = drift;
        this.still = drift.isNone();
    }

    /** A frame's detections where they stand in the scene. */
    FrameDetections inScene(FrameDetections frame) {
        if (still) {
            return frame;
        }
        List<Detection> moved = new ArrayList<>();
        for (Detection detection : frame.detections()) {
            Detection there = detection.at(moved(detection.box(), -frame.driftX(), -frame.driftY()));
            found.put(there, detection);
            moved.add(there);
        }
        return new FrameDetections(frame.frame(), moved);
    }

    /** A track's points as the film shows them; what was found is the very object it was. */
    List<TrackPoint> inFilm(List<TrackPoint> points) {
        return still ? points : points.stream().map(this::inFilm).toList();
    }

    private TrackPoint inFilm(TrackPoint point) {
        Detection detection = point.detection() == null ? null : found.get(point.detection());
        Box box = detection != null && point.box().equals(point.detection().box())
                ? detection.box()
                : moved(point.box(), drift.x(point.frame()), drift.y(point.frame()));
        return new TrackPoint(point.frame(), box, detection);
    }

    private static Box moved(Box box, double x, double y) {
        return new Box(box.xMin() + x, box.yMin() + y, box.xMax() + x, box.yMax() + y);
    }
}
