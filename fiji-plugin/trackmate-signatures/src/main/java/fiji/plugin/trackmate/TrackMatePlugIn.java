// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

public class TrackMatePlugIn {
    public void run(String argument) {
        throw new UnsupportedOperationException();
    }
}
