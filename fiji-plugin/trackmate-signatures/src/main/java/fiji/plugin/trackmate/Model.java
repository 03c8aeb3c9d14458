// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

public class Model {
    public SpotCollection getSpots() {
        throw new UnsupportedOperationException();
    }

    public void setSpots(SpotCollection spots, boolean notify) {
        throw new UnsupportedOperationException();
    }

    public void setLogger(Logger logger) {
        throw new UnsupportedOperationException();
    }

    public TrackModel getTrackModel() {
        throw new UnsupportedOperationException();
    }

    public String getSpaceUnits() {
        throw new UnsupportedOperationException();
    }

    public String getTimeUnits() {
        throw new UnsupportedOperationException();
    }
}
