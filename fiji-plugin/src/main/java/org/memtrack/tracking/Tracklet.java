// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.Detection;

/** A track that still grows. */
final class Tracklet {
    private final MotionModel model;
    private final List<TrackPoint> points = new ArrayList<>();
    private BoxState state;
    private BoxState lastDetected;
    private @Nullable Detection detection;
    private int framesWithoutDetection;
    private int hits;
    private int hitStreak;

    Tracklet(Detection first, MotionModel model) {
        this.model = model;
        this.state = BoxState.start(first.box(), model);
        this.lastDetected = state;
        this.detection = first;
        this.hits = 1;
    }

    /** One frame later, not detected so far. */
    void predict() {
        state = state.predict(model);
        detection = null;
        if (framesWithoutDetection > 0) {
            hitStreak = 0;
        }
        framesWithoutDetection++;
    }

    void update(Detection found) {
        state = state.update(found.box(), model);
        lastDetected = state;
        detection = found;
        framesWithoutDetection = 0;
        hits++;
        hitStreak++;
    }

    void add(TrackPoint point) {
        points.add(point);
    }

    BoxState state() {
        return state;
    }

    /** What was known right after its last detection. */
    BoxState lastDetected() {
        return lastDetected;
    }

    /** As what it was detected in the present frame, or null. */
    @Nullable
    Detection detection() {
        return detection;
    }

    /** Frames since its last detection, 0 when it was detected in the present one. */
    int framesWithoutDetection() {
        return framesWithoutDetection;
    }

    /** Detections in all. */
    int hits() {
        return hits;
    }

    /** Detections in a row; as in SORT, the one that began the tracklet does not count. */
    int hitStreak() {
        return hitStreak;
    }

    List<TrackPoint> points() {
        return points;
    }
}
