// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.gui.components;

import java.util.Map;
import javax.swing.JPanel;

public abstract class ConfigurationPanel extends JPanel {
    private static final long serialVersionUID = 1;

    public abstract void setSettings(Map<String, Object> settings);

    public abstract Map<String, Object> getSettings();

    public abstract void clean();
}
