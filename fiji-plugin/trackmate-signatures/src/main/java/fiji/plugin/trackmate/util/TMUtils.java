// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.util;

import ij.ImagePlus;
import net.imagej.ImgPlus;

public class TMUtils {
    private TMUtils() {}

    @SuppressWarnings("rawtypes")
    public static final ImgPlus rawWraps(ImagePlus image) {
        throw new UnsupportedOperationException();
    }
}
