// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import java.util.Set;

public class TrackModel {
    TrackModel() {}

    public Set<Integer> trackIDs(boolean visibleOnly) {
        throw new UnsupportedOperationException();
    }

    public Set<Spot> trackSpots(Integer trackId) {
        throw new UnsupportedOperationException();
    }

    public String name(Integer trackId) {
        throw new UnsupportedOperationException();
    }
}
