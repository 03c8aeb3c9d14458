// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;
import org.memtrack.detection.Box;
import org.memtrack.formats.SpotFeature;

/** Makes spots, the one place to do so since TrackMate 9 will make them by another class, and reads them. */
final class Spots {
    private Spots() {}

    /**
     * A spot in the plane.
     *
     * @param x centre, in the model's unit of length
     * @param y centre, likewise
     * @param radius likewise
     * @param quality as TrackMate understands it: the greater, the surer
     */
    static Spot at(double x, double y, double radius, double quality) {
        return new Spot(x, y, 0, radius, quality);
    }

    /** Whether it carries the box of what MEMTrack saw; another detector's radius is a setting of it, not a size. */
    static boolean hasBox(Spot spot) {
        return value(spot, SpotFeature.BOX_WIDTH.key(), 0) > 0;
    }

    /**
     * The box of a spot, in pixels: the one the detector gave, else the square around the spot's radius, to track by and not
     * to measure.
     *
     * @param pixelWidth edge of a pixel, in the unit of length of the spot
     * @param pixelHeight likewise
     */
    static Box box(Spot spot, double pixelWidth, double pixelHeight) {
        double diameter = 2 * value(spot, Spot.RADIUS, 0);
        return Box.around(
                spot.getDoublePosition(0) / pixelWidth,
                spot.getDoublePosition(1) / pixelHeight,
                value(spot, SpotFeature.BOX_WIDTH.key(), diameter) / pixelWidth,
                value(spot, SpotFeature.BOX_HEIGHT.key(), diameter) / pixelHeight);
    }

    /** Whether the tracker put it where no detection was found. */
    static boolean interpolated(Spot spot) {
        return value(spot, SpotFeature.INTERPOLATED.key(), 0) == 1;
    }

    /** Frame of a spot that is in a collection, from 0. */
    static int frame(Spot spot) {
        return (int) value(spot, Spot.FRAME, 0);
    }

    /** The value of a feature, if it has a finite one. */
    static double value(Spot spot, String feature, double otherwise) {
        Double value = spot.getFeature(feature);
        return value == null || !Double.isFinite(value) ? otherwise : value;
    }
}
