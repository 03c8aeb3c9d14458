// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.Detection;
import org.memtrack.tracking.Axis.Noise;

/** A track that still grows. */
final class Tracklet {
    /** How much less a contrast says that was measured where others are near. */
    private static final double CROWDED = 10;

    private final MotionModel model;
    private final @Nullable ContrastModel contrastModel;
    private final List<TrackPoint> points = new ArrayList<>();
    private BoxState state;
    private BoxState lastDetected;
    private @Nullable Axis contrast;
    private @Nullable Detection detection;
    private int framesWithoutDetection;
    private int hitStreak;

    Tracklet(Detection first, SwimmerModel swimmers) {
        this.model = swimmers.motion();
        this.contrastModel = swimmers.contrast();
        this.contrast = contrastModel == null ? null : Axis.start(first.contrast(), contrastModel.noise());
        this.state = BoxState.start(first.box(), model);
        this.lastDetected = state;
        this.detection = first;
    }

    /** One frame later, not detected so far. */
    void predict() {
        state = state.predict(model);
        if (contrast != null) {
            contrast = contrast.predict(contrastModel.noise());
        }
        detection = null;
        if (framesWithoutDetection > 0) {
            hitStreak = 0;
        }
        framesWithoutDetection++;
    }

    /**
     * Detected in the present frame.
     *
     * @param alone no other detection is near, and its contrast is its own
     */
    void update(Detection found, boolean alone) {
        state = state.update(found.box(), model);
        if (contrast != null) {
            Noise noise = contrastModel.noise();
            contrast = contrast.update(
                    found.contrast(), alone ? noise : noise.withMeasurement(CROWDED * noise.measurement()));
        }
        lastDetected = state;
        detection = found;
        framesWithoutDetection = 0;
        hitStreak++;
    }

    void add(TrackPoint point) {
        points.add(point);
    }

    BoxState state() {
        return state;
    }

    /** Its contrast, predicted to the present frame; null when nothing is known of contrasts. */
    @Nullable
    Axis contrast() {
        return contrast;
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

    /** Detections in a row; as in SORT, the one that began the tracklet does not count. */
    int hitStreak() {
        return hitStreak;
    }

    List<TrackPoint> points() {
        return points;
    }
}
