// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

public class LoadTrackMatePlugIn {
    public void run(String filePath) {
        throw new UnsupportedOperationException();
    }
}
