// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.gui.displaysettings;

public class DisplaySettings {
    DisplaySettings() {}
}
