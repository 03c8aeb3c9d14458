// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.action;

import fiji.plugin.trackmate.Logger;

public abstract class AbstractTMAction implements TrackMateAction {
    protected Logger logger;

    @Override
    public void setLogger(Logger logger) {
        throw new UnsupportedOperationException();
    }
}
