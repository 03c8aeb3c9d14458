// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;

/**
 * One bacterium or microrobot through consecutive frames.
 *
 * @param id number of the track, from 0, unique within a film
 * @param points at least one, one a frame, without a gap, in order of frame
 */
public record Track(int id, List<TrackPoint> points) {
    public Track {
        if (id < 0 || points.isEmpty()) {
            throw new IllegalArgumentException("Track %d has %d points".formatted(id, points.size()));
        }
        points = List.copyOf(points);
        for (int i = 1; i < points.size(); i++) {
            if (points.get(i).frame() != points.get(i - 1).frame() + 1) {
                throw new IllegalArgumentException("Track %d steps from frame %d to frame %d"
                        .formatted(id, points.get(i - 1).frame(), points.get(i).frame()));
            }
        }
    }

    public int firstFrame() {
        return points.get(0).frame();
    }

    public int lastFrame() {
        return points.get(points.size() - 1).frame();
    }

    /** Length in frames, interpolated ones included. */
    public int length() {
        return points.size();
    }
}
