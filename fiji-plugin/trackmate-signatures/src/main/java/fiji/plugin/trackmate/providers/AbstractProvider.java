// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.providers;

import fiji.plugin.trackmate.TrackMateModule;
import java.util.List;

public abstract class AbstractProvider<K extends TrackMateModule> {
    public AbstractProvider(Class<K> type) {
        throw new UnsupportedOperationException();
    }

    public List<String> getKeys() {
        throw new UnsupportedOperationException();
    }

    public K getFactory(String key) {
        throw new UnsupportedOperationException();
    }
}
