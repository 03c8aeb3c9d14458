// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.tracking;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.gui.components.ConfigurationPanel;
import ij.ImagePlus;
import java.util.Map;

public interface SpotImageTrackerFactory extends SpotTrackerFactory {
    SpotTracker create(SpotCollection spots, Map<String, Object> settings, ImagePlus input);

    @Override
    default SpotTracker create(SpotCollection spots, Map<String, Object> settings) {
        throw new UnsupportedOperationException();
    }

    ConfigurationPanel getTrackerConfigurationPanel(Model model, ImagePlus input);

    @Override
    default ConfigurationPanel getTrackerConfigurationPanel(Model model) {
        throw new UnsupportedOperationException();
    }
}
