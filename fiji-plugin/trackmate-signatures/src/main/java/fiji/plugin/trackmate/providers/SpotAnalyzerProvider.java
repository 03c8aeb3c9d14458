// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.providers;

import fiji.plugin.trackmate.features.spot.SpotAnalyzerFactory;

@SuppressWarnings("rawtypes")
public class SpotAnalyzerProvider extends AbstractProvider<SpotAnalyzerFactory> {
    public SpotAnalyzerProvider(int nChannels) {
        super(SpotAnalyzerFactory.class);
        throw new UnsupportedOperationException();
    }

    @Override
    public SpotAnalyzerFactory getFactory(String key) {
        throw new UnsupportedOperationException();
    }
}
