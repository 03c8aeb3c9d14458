// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.action;

import fiji.plugin.trackmate.Logger;
import fiji.plugin.trackmate.SelectionModel;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.gui.displaysettings.DisplaySettings;
import java.awt.Frame;

public interface TrackMateAction {
    void execute(TrackMate trackmate, SelectionModel selection, DisplaySettings display, Frame parent);

    void setLogger(Logger logger);
}
