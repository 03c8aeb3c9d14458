// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import org.memtrack.detection.Box;

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
     * @param tracks what was found of each, in the scene, in order of frame, at least one point
     */
    static List<List<TrackPoint>> joined(List<List<TrackPoint>> tracks) {
        List<List<TrackPoint>> found = new ArrayList<>(tracks);
        List<List<TrackPoint>> whole =
                new ArrayList<>(found.stream().map(GapFilling::fill).toList());
        for (int i = 0; i < found.size(); i++) {
            int j = i + 1;
            while (j < found.size()) {
                if (areOne(whole.get(i), whole.get(j))) {
                    found.set(i, union(found.get(i), found.remove(j)));
                    whole.set(i, GapFilling.fill(found.get(i)));
                    whole.remove(j);
                    j = i + 1;
                } else {
                    j++;
                }
            }
        }
        return found;
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
            distances += distance(here.box(), there.box());
            both += here.interpolated() || there.interpolated() ? 0 : 1;
        }
        return frames >= LEAST_FRAMES && distances <= most && both <= BOTH * frames;
    }

    private static double distance(Box one, Box other) {
        return Math.hypot(one.centreX() - other.centreX(), one.centreY() - other.centreY());
    }

    private static List<TrackPoint> union(List<TrackPoint> one, List<TrackPoint> other) {
        List<TrackPoint> more = one.size() >= other.size() ? one : other;
        List<TrackPoint> less = more == one ? other : one;
        List<TrackPoint> all = new ArrayList<>();
        int next = 0;
        for (TrackPoint point : more) {
            for (; next < less.size() && less.get(next).frame() <= point.frame(); next++) {
                if (less.get(next).frame() < point.frame()) {
                    all.add(less.get(next));
                }
            }
            all.add(point);
        }
        all.addAll(less.subList(next, less.size()));
        return all;
    }
}
