// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;

/**
 * One bacterium or microrobot from frame to frame.
 *
 * @param id number of the track, from 0, unique within a film
 * @param points at least one, at most one a frame, in order of frame. With {@link Interpolation#FILL_GAPS} none is
 *     missing between the first and the last; with {@link Interpolation#AUTHORS} some may be, as in SORT
 */
public record Track(int id, List<TrackPoint> points) {
    public Track {
        if (id < 0 || points.isEmpty()) {
            throw new IllegalArgumentException("Track %d has %d points".formatted(id, points.size()));
        }
        points = List.copyOf(points);
        for (int i = 1; i < points.size(); i++) {
            if (points.get(i).frame() <= points.get(i - 1).frame()) {
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

    /** Frames from the first to the last, both included. */
    public int length() {
        return lastFrame() - firstFrame() + 1;
    }
}
