// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.io;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import ij.ImagePlus;
import java.io.File;

public class TmXmlReader {
    public TmXmlReader(File file) {
        throw new UnsupportedOperationException();
    }

    public Model getModel() {
        throw new UnsupportedOperationException();
    }

    public ImagePlus readImage() {
        throw new UnsupportedOperationException();
    }

    public Settings readSettings(ImagePlus image) {
        throw new UnsupportedOperationException();
    }
}
