// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.tracking.Matching.Pair;

/**
 * SORT's association: Hungarian assignment on intersection over union, then the gate (Bewley et al. 2016, section 3.3).
 *
 * @param gate least intersection over union of a match
 */
record OverlapAssociation(double gate) implements Associator {

    @Override
    public List<Pair> match(List<Tracklet> tracklets, List<Detection> detections) {
        List<Pair> overlapping = overlapping(tracklets, detections);
        List<Pair> clear =
                overlapping.stream().filter(pair -> pair.gain() > gate).toList();
        // SORT as published: without rivals above the gate there is nothing to assign. The assignment could still
        // differ
        // from this, since it counts overlaps below the gate too.
        if (!clear.isEmpty() && oneToOne(clear)) {
            return clear;
        }
        return Matching.best(tracklets.size(), detections.size(), overlapping).stream()
                .filter(pair -> pair.gain() >= gate)
                .toList();
    }

    private static List<Pair> overlapping(List<Tracklet> tracklets, List<Detection> detections) {
        DetectionsAlongX alongX = new DetectionsAlongX(detections);
        double widest =
                detections.stream().mapToDouble(d -> d.box().width()).max().orElse(0);
        List<Pair> pairs = new ArrayList<>();
        for (int i = 0; i < tracklets.size(); i++) {
            int track = i;
            Box box = tracklets.get(i).state().box();
            alongX.forEachNear(box.centreX(), (box.width() + widest) / 2, detection -> {
                double iou = box.iou(detections.get(detection).box());
                if (iou > 0) {
                    pairs.add(new Pair(track, detection, iou));
                }
            });
        }
        return pairs;
    }

    private static boolean oneToOne(List<Pair> pairs) {
        Set<Integer> tracks = new HashSet<>();
        Set<Integer> detections = new HashSet<>();
        return pairs.stream().allMatch(pair -> tracks.add(pair.track()) && detections.add(pair.detection()));
    }
}
