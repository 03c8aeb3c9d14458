// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import org.scijava.Cancelable;

public class TrackMate implements Cancelable {
    public TrackMate(Settings settings) {
        throw new UnsupportedOperationException();
    }

    public TrackMate(Model model, Settings settings) {
        throw new UnsupportedOperationException();
    }

    public Model getModel() {
        throw new UnsupportedOperationException();
    }

    public Settings getSettings() {
        throw new UnsupportedOperationException();
    }

    public boolean execDetection() {
        throw new UnsupportedOperationException();
    }

    public String getErrorMessage() {
        throw new UnsupportedOperationException();
    }

    @Override
    public boolean isCanceled() {
        throw new UnsupportedOperationException();
    }

    @Override
    public void cancel(String reason) {
        throw new UnsupportedOperationException();
    }

    @Override
    public String getCancelReason() {
        throw new UnsupportedOperationException();
    }
}
