// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import java.util.NavigableMap;
import java.util.TreeMap;

/**
 * Tracks that share one swimmer, made one. Where a long one makes two boxes now and then, a second track may begin on it;
 * from then on each frame's box goes to one track or the other, and both are interpolated in turns.
 */
final class Twins {
    /** Mean distance of such tracks, as a share of a box's edge, at most. */
    private static final double NEAR = 1 / 3.0;

    /** Share of their common frames in which both are found, at most; of two swimmers side by side both are, mostly. */
    private static final double BOTH = 0.25;

    /** Least number of common frames. */
    private static final int LEAST_FRAMES = 8;

    private Twins() {}

    /**
     * The tracks, those that share a swimmer joined. In a frame in which both were found the box of the one that was found
     * more often counts.
     *
     * @param tracks in the scene, each frame of them filled, at least one point
     */
    static List<List<TrackPoint>> joined(List<List<TrackPoint>> tracks) {
        List<List<TrackPoint>> joined = new ArrayList<>(tracks);
        for (int i = 0; i < joined.size(); i++) {
            int j = i + 1;
            while (j < joined.size()) {
                if (areOne(joined.get(i), joined.get(j))) {
                    joined.set(i, union(joined.get(i), joined.remove(j)));
                    j = i + 1;
                } else {
                    j++;
                }
            }
        }
        return joined;
    }

    private static boolean areOne(List<TrackPoint> one, List<TrackPoint> other) {
        int oneBegins = one.get(0).frame();
        int otherBegins = other.get(0).frame();
        int first = Math.max(oneBegins, otherBegins);
        int frames = Math.min(oneBegins + one.size(), otherBegins + other.size()) - first;
        double most = NEAR * Math.sqrt(one.get(0).box().area()) * frames;
        double distances = 0;
        int both = 0;
        for (int frame = first; frame < first + frames && distances <= most; frame++) {
            TrackPoint here = one.get(frame - oneBegins);
            TrackPoint there = other.get(frame - otherBegins);
            distances += here.box().distance(there.box());
            both += here.interpolated() || there.interpolated() ? 0 : 1;
        }
        return frames >= LEAST_FRAMES && distances <= most && both <= BOTH * frames;
    }

    private static List<TrackPoint> union(List<TrackPoint> one, List<TrackPoint> other) {
        List<TrackPoint> oneFound = found(one);
        List<TrackPoint> otherFound = found(other);
        boolean oneIsMore = oneFound.size() >= otherFound.size();
        NavigableMap<Integer, TrackPoint> all = new TreeMap<>();
        (oneIsMore ? otherFound : oneFound).forEach(point -> all.put(point.frame(), point));
        (oneIsMore ? oneFound : otherFound).forEach(point -> all.put(point.frame(), point));
        return GapFilling.fill(List.copyOf(all.values()));
    }

    private static List<TrackPoint> found(List<TrackPoint> points) {
        return points.stream().filter(point -> !point.interpolated()).toList();
    }
}
