// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.IntStream;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.tracking.Matching.Pair;

/**
 * SORT's association: Hungarian assignment on intersection over union, then the gate (Bewley et al. 2016, section 3.3).
 *
 * @param gate least intersection over union of a match
 */
record OverlapAssociation(double gate) {

    /** Matches of predicted and detected boxes, by their indices. */
    List<Pair> match(List<Box> predicted, List<Detection> detections) {
        List<Pair> overlapping = overlapping(predicted, detections);
        List<Pair> clear =
                overlapping.stream().filter(pair -> pair.gain() > gate).toList();
        // SORT as published: without rivals above the gate there is nothing to assign. The assignment could still
        // differ
        // from this, since it counts overlaps below the gate too.
        if (!clear.isEmpty() && oneToOne(clear)) {
            return clear;
        }
        return Matching.best(predicted.size(), detections.size(), overlapping).stream()
                .filter(pair -> pair.gain() >= gate)
                .toList();
    }

    private static boolean oneToOne(List<Pair> pairs) {
        Set<Integer> tracks = new HashSet<>();
        Set<Integer> detections = new HashSet<>();
        return pairs.stream().allMatch(pair -> tracks.add(pair.track()) && detections.add(pair.detection()));
    }

    /** Every pair of boxes that overlap, found by a sweep along x. */
    private static List<Pair> overlapping(List<Box> predicted, List<Detection> detections) {
        int[] byLeftEdge = IntStream.range(0, detections.size())
                .boxed()
                .sorted(Comparator.comparingDouble(i -> detections.get(i).box().xMin()))
                .mapToInt(Integer::intValue)
                .toArray();
        double widest =
                detections.stream().mapToDouble(d -> d.box().width()).max().orElse(0);
        List<Pair> pairs = new ArrayList<>();
        for (int track = 0; track < predicted.size(); track++) {
            Box box = predicted.get(track);
            int first = firstRightOf(box.xMin() - widest, byLeftEdge, detections);
            for (int i = first; i < byLeftEdge.length; i++) {
                Box detected = detections.get(byLeftEdge[i]).box();
                if (detected.xMin() >= box.xMax()) {
                    break;
                }
                double iou = box.iou(detected);
                if (iou > 0) {
                    pairs.add(new Pair(track, byLeftEdge[i], iou));
                }
            }
        }
        return pairs;
    }

    private static int firstRightOf(double x, int[] byLeftEdge, List<Detection> detections) {
        int low = 0;
        int high = byLeftEdge.length;
        while (low < high) {
            int middle = (low + high) >>> 1;
            if (detections.get(byLeftEdge[middle]).box().xMin() < x) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low;
    }
}
