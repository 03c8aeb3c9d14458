// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;

/**
 * A second look, for cells so faint that the detector is hardly sure of them in any single frame: what no track accounts
 * for, boxes below the thresholds among it, is joined once more.
 *
 * <p>A box of a low score is most often none, and the same speck or bent fibre can make one in every frame: so a track of
 * such boxes is kept only when it was found often and travels. All constants were chosen on simulated films of their own.
 */
final class SecondLook {
    /** Frames such a track must have been found in, however short tracks may be otherwise. */
    private static final int LEAST_FOUND = 30;

    /** Least mean score of the frames it was found in. */
    private static final double LEAST_SCORE = 0.35;

    /** How far its points must lie from their mean, root mean square, as a share of a box's edge; false ones stay put. */
    private static final double LEAST_TRAVEL = 1 / 15.0;

    /** A box this near to a point of a track, as a share of its edge, is accounted for. */
    private static final double ACCOUNTED = 0.4;

    private SecondLook() {}

    /** Detections and faint boxes of each frame that lie beside all points of the tracks. */
    static List<FrameDetections> unaccounted(List<FrameDetections> frames, List<List<TrackPoint>> tracks) {
        Map<Integer, List<Box>> taken = new HashMap<>();
        tracks.forEach(points -> points.forEach(point ->
                taken.computeIfAbsent(point.frame(), frame -> new ArrayList<>()).add(point.box())));
        return frames.stream()
                .map(frame -> new FrameDetections(
                        frame.frame(),
                        Stream.concat(frame.detections().stream(), frame.faint().stream())
                                .filter(detection -> isFree(detection, taken.getOrDefault(frame.frame(), List.of())))
                                .toList(),
                        frame.driftX(),
                        frame.driftY()))
                .toList();
    }

    /**
     * Whether a track is that of a cell.
     *
     * @param found its points that were found, in the scene, at least one
     * @param minimumScore least mean score the user asks of a track
     */
    static boolean isCell(List<TrackPoint> found, double minimumScore) {
        return found.size() >= LEAST_FOUND
                && mean(found.stream()
                                .mapToDouble(point -> point.detection().score())
                                .toArray())
                        >= Math.max(LEAST_SCORE, minimumScore)
                && travel(found) >= LEAST_TRAVEL * edge(found.get(0).box());
    }

    private static boolean isFree(Detection detection, List<Box> taken) {
        Box box = detection.box();
        double reach = ACCOUNTED * edge(box);
        return taken.stream().noneMatch(other -> other.distance(box) < reach);
    }

    private static double travel(List<TrackPoint> points) {
        double[] x = points.stream().mapToDouble(point -> point.box().centreX()).toArray();
        double[] y = points.stream().mapToDouble(point -> point.box().centreY()).toArray();
        return Math.sqrt(variance(x) + variance(y));
    }

    private static double variance(double[] values) {
        double mean = mean(values);
        double sum = 0;
        for (double value : values) {
            sum += (value - mean) * (value - mean);
        }
        return sum / values.length;
    }

    private static double mean(double[] values) {
        double sum = 0;
        for (double value : values) {
            sum += value;
        }
        return sum / values.length;
    }

    private static double edge(Box box) {
        return Math.sqrt(box.area());
    }
}
