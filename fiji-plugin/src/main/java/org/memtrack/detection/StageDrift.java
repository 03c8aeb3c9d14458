// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.detection;

import java.util.List;
import java.util.Map;
import java.util.NavigableMap;
import java.util.TreeMap;

/** How far the scene stands from its place in frame 0, in every frame; in one left out, as in the one before it. */
public final class StageDrift {
    private final NavigableMap<Integer, FrameDetections> frames = new TreeMap<>();

    /** What the detector measured. */
    public StageDrift(List<FrameDetections> frames) {
        frames.forEach(frame -> this.frames.put(frame.frame(), frame));
    }

    /** Whether the scene stands still. */
    public boolean isNone() {
        return frames.values().stream().allMatch(frame -> frame.driftX() == 0 && frame.driftY() == 0);
    }

    /** To the right, pixels. */
    public double x(int frame) {
        Map.Entry<Integer, FrameDetections> entry = frames.floorEntry(frame);
        return entry == null ? 0 : entry.getValue().driftX();
    }

    /** Downwards, pixels. */
    public double y(int frame) {
        Map.Entry<Integer, FrameDetections> entry = frames.floorEntry(frame);
        return entry == null ? 0 : entry.getValue().driftY();
    }
}
