// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.tracking;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.TrackMateFactoryBase;
import fiji.plugin.trackmate.gui.components.ConfigurationPanel;
import java.util.Map;

public interface SpotTrackerFactory extends TrackMateFactoryBase<SpotTrackerFactory> {
    SpotTracker create(SpotCollection spots, Map<String, Object> settings);

    ConfigurationPanel getTrackerConfigurationPanel(Model model);
}
