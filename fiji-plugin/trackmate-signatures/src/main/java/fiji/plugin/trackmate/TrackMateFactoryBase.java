// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import java.util.Map;
import org.jdom2.Element;

public interface TrackMateFactoryBase<F extends TrackMateFactoryBase<F>> extends TrackMateModule {
    default String marshal(Map<String, Object> settings, Element element) {
        throw new UnsupportedOperationException();
    }

    default String unmarshal(Element element, Map<String, Object> settings) {
        throw new UnsupportedOperationException();
    }

    Map<String, Object> getDefaultSettings();

    default String checkSettings(Map<String, Object> settings) {
        throw new UnsupportedOperationException();
    }

    default String toString(Map<String, Object> settings) {
        throw new UnsupportedOperationException();
    }

    default F copy() {
        throw new UnsupportedOperationException();
    }
}
