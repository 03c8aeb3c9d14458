// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import java.util.NavigableSet;
import net.imglib2.algorithm.MultiThreaded;

public class SpotCollection implements MultiThreaded {
    public static final String VISIBILITY = "VISIBILITY";

    public SpotCollection() {
        throw new UnsupportedOperationException();
    }

    public void add(Spot spot, Integer frame) {
        throw new UnsupportedOperationException();
    }

    public boolean remove(Spot spot, Integer frame) {
        throw new UnsupportedOperationException();
    }

    public final int getNSpots(boolean visibleSpotsOnly) {
        throw new UnsupportedOperationException();
    }

    public Iterable<Spot> iterable(boolean visibleSpotsOnly) {
        throw new UnsupportedOperationException();
    }

    public Iterable<Spot> iterable(int frame, boolean visibleSpotsOnly) {
        throw new UnsupportedOperationException();
    }

    public NavigableSet<Integer> keySet() {
        throw new UnsupportedOperationException();
    }

    @Override
    public void setNumThreads() {
        throw new UnsupportedOperationException();
    }

    @Override
    public void setNumThreads(int numThreads) {
        throw new UnsupportedOperationException();
    }

    @Override
    public int getNumThreads() {
        throw new UnsupportedOperationException();
    }
}
