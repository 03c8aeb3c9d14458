// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.action;

import fiji.plugin.trackmate.TrackMateModule;

public interface TrackMateActionFactory extends TrackMateModule {
    TrackMateAction create();
}
