// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.features.spot;

import fiji.plugin.trackmate.Spot;

public interface SpotAnalyzer<T> {
    void process(Iterable<Spot> spots);
}
