// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;

/** The one place where spots are made: TrackMate 9 will make them by another class. */
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
}
