// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import javax.swing.ImageIcon;
import org.scijava.plugin.SciJavaPlugin;

public interface TrackMateModule extends SciJavaPlugin {
    String getInfoText();

    default ImageIcon getIcon() {
        throw new UnsupportedOperationException();
    }

    String getKey();

    String getName();

    default boolean forbidMultithreading() {
        throw new UnsupportedOperationException();
    }

    default String getUrl() {
        throw new UnsupportedOperationException();
    }
}
