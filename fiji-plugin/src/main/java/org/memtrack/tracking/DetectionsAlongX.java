// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.Comparator;
import java.util.List;
import java.util.function.IntConsumer;
import java.util.stream.IntStream;
import org.memtrack.detection.Detection;

/** Finds the detections near a place without looking at all of them. */
final class DetectionsAlongX {
    private final int[] order;
    private final double[] x;

    DetectionsAlongX(List<Detection> detections) {
        order = IntStream.range(0, detections.size())
                .boxed()
                .sorted(Comparator.comparingDouble(i -> detections.get(i).box().centreX()))
                .mapToInt(Integer::intValue)
                .toArray();
        x = IntStream.of(order)
                .mapToDouble(i -> detections.get(i).box().centreX())
                .toArray();
    }

    /** Visits the index of each detection whose centre lies so near in x, pixels. */
    void forEachNear(double centreX, double reach, IntConsumer visitor) {
        int low = 0;
        int high = x.length;
        while (low < high) {
            int middle = (low + high) >>> 1;
            if (x[middle] < centreX - reach) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        for (int i = low; i < x.length && x[i] <= centreX + reach; i++) {
            visitor.accept(order[i]);
        }
    }
}
