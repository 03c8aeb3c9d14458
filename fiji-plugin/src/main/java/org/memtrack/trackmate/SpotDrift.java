// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import java.util.ArrayList;
import java.util.List;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.SpotFeature;

/**
 * The drift of the stage on its way through TrackMate: the detector leaves it on its spots, and the tracker and the motility
 * analysis read it there, also after a file was saved and loaded.
 */
final class SpotDrift {
    private SpotDrift() {}

    /**
     * Leaves the drift of its frame on a spot.
     *
     * @param x how far the scene stands right of its place in the first frame, in the model's unit of length
     * @param y how far it stands below, likewise
     */
    static void put(Spot spot, double x, double y) {
        spot.putFeature(SpotFeature.DRIFT_X.key(), x);
        spot.putFeature(SpotFeature.DRIFT_Y.key(), y);
    }

    /**
     * Frames with their drift in pixels and no detections; one in which no spot tells the drift is left out.
     *
     * @param pixelWidth edge of a pixel, in the unit of length of the spots
     * @param pixelHeight likewise
     */
    static List<FrameDetections> of(SpotCollection spots, double pixelWidth, double pixelHeight) {
        List<FrameDetections> frames = new ArrayList<>();
        for (int frame : spots.keySet()) {
            for (Spot spot : spots.iterable(frame, false)) {
                double x = Spots.value(spot, SpotFeature.DRIFT_X.key(), Double.NaN) / pixelWidth;
                double y = Spots.value(spot, SpotFeature.DRIFT_Y.key(), Double.NaN) / pixelHeight;
                if (Double.isFinite(x) && Double.isFinite(y)) {
                    frames.add(new FrameDetections(frame, List.of(), x, y));
                    break;
                }
            }
        }
        return frames;
    }
}
