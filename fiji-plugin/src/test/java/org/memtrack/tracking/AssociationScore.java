// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.HashMap;
import java.util.Map;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.testing.RandomWorld;

/**
 * How well tracks keep to their swimmers, over the detections of swimmers.
 *
 * @param switches times that a swimmer's detections go over from one track to another
 * @param association HOTA's association accuracy, in [0, 1]: over the detections, the mean of the intersection over union
 *     of the detection's swimmer and its track, both as sets of detections
 * @param gapError root mean square distance of interpolated points from their swimmer, pixels
 * @param interpolated interpolated points that the error was measured over
 */
record AssociationScore(int switches, double association, double gapError, int interpolated) {

    static AssociationScore of(RandomWorld world, Iterable<Track> tracks) {
        Map<Detection, Integer> trackOf = new java.util.IdentityHashMap<>();
        Map<Integer, Integer> trackSize = new HashMap<>();
        double squares = 0;
        int interpolated = 0;
        for (Track track : tracks) {
            for (TrackPoint point : track.points()) {
                if (point.detection() != null) {
                    trackOf.put(point.detection(), track.id());
                    trackSize.merge(track.id(), 1, Integer::sum);
                }
            }
            Integer swimmer = only(world, track);
            for (TrackPoint point : track.points()) {
                if (point.interpolated() && swimmer != null) {
                    double[] truth = world.truth().get(swimmer)[point.frame()];
                    double distance = Math.hypot(
                            point.box().centreX() - truth[0], point.box().centreY() - truth[1]);
                    squares += distance * distance;
                    interpolated++;
                }
            }
        }
        Map<Integer, Integer> swimmerSize = new HashMap<>();
        Map<Long, Integer> common = new HashMap<>();
        Map<Integer, Integer> lastTrack = new HashMap<>();
        int switches = 0;
        for (FrameDetections frame : world.frames()) {
            for (Detection detection : frame.detections()) {
                Integer swimmer = world.swimmerOf().get(detection);
                if (swimmer != null) {
                    int track = trackOf.getOrDefault(detection, -1);
                    swimmerSize.merge(swimmer, 1, Integer::sum);
                    common.merge(key(swimmer, track), 1, Integer::sum);
                    Integer before = lastTrack.put(swimmer, track);
                    switches += before != null && before != track ? 1 : 0;
                }
            }
        }
        double sum = 0;
        int count = 0;
        for (Map.Entry<Long, Integer> entry : common.entrySet()) {
            int swimmer = (int) (entry.getKey() >> 32);
            int track = (int) (long) entry.getKey();
            int both = entry.getValue();
            count += both;
            if (track >= 0) {
                sum += both * (double) both / (swimmerSize.get(swimmer) + trackSize.get(track) - both);
            }
        }
        return new AssociationScore(switches, sum / count, Math.sqrt(squares / interpolated), interpolated);
    }

    /** The swimmer of a track that holds detections of one swimmer only. */
    private static Integer only(RandomWorld world, Track track) {
        var swimmers = track.points().stream()
                .filter(point -> !point.interpolated())
                .map(point -> world.swimmerOf().getOrDefault(point.detection(), -1))
                .distinct()
                .toList();
        return swimmers.size() == 1 && swimmers.get(0) >= 0 ? swimmers.get(0) : null;
    }

    private static long key(int swimmer, int track) {
        return ((long) swimmer << 32) | (track & 0xffffffffL);
    }
}
