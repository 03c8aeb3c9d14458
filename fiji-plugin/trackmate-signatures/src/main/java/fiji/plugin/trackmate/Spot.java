// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import net.imglib2.AbstractEuclideanSpace;
import net.imglib2.RealLocalizable;

public class Spot extends AbstractEuclideanSpace implements RealLocalizable, Comparable<Spot> {
    public static final String QUALITY = "QUALITY";
    public static final String RADIUS = "RADIUS";
    public static final String POSITION_T = "POSITION_T";
    public static final String FRAME = "FRAME";

    public Spot(double x, double y, double z, double radius, double quality) {
        super(3);
        throw new UnsupportedOperationException();
    }

    public int ID() {
        throw new UnsupportedOperationException();
    }

    public Double getFeature(String feature) {
        throw new UnsupportedOperationException();
    }

    public void putFeature(String feature, Double value) {
        throw new UnsupportedOperationException();
    }

    @Override
    public double getDoublePosition(int dimension) {
        throw new UnsupportedOperationException();
    }

    @Override
    public int compareTo(Spot other) {
        throw new UnsupportedOperationException();
    }
}
