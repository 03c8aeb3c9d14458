// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.Comparator;
import java.util.List;
import java.util.function.IntConsumer;
import java.util.stream.IntStream;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;

/** Finds the detections near a place without looking at all of them. */
final class DetectionsAlongX {
    private final List<Detection> detections;
    private final int[] order;
    private final double[] x;

    DetectionsAlongX(List<Detection> detections) {
        this.detections = detections;
        order = IntStream.range(0, detections.size())
                .boxed()
                .sorted(Comparator.comparingDouble(i -> detections.get(i).box().centreX()))
                .mapToInt(Integer::intValue)
                .toArray();
        x = IntStream.of(order)
                .mapToDouble(i -> detections.get(i).box().centreX())
                .toArray();
    }

    /** Whether the centre of no other detection is so near, pixels. */
    boolean isAlone(Detection detection, double reach) {
        double x = detection.box().centreX();
        double y = detection.box().centreY();
        int[] near = {0};
        forEachNear(x, reach, i -> {
            Box other = detections.get(i).box();
            near[0] += Math.hypot(other.centreX() - x, other.centreY() - y) < reach ? 1 : 0;
        });
        return near[0] <= 1;
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
