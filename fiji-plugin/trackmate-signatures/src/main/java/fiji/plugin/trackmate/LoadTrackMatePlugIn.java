// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import fiji.plugin.trackmate.io.TmXmlReader;
import java.io.File;

public class LoadTrackMatePlugIn extends TrackMatePlugIn {
    @Override
    public void run(String filePath) {
        throw new UnsupportedOperationException();
    }

    protected TmXmlReader createReader(File file) {
        throw new UnsupportedOperationException();
    }
}
