// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import fiji.plugin.trackmate.TrackMateFactoryBase;
import fiji.plugin.trackmate.detection.SpotGlobalDetectorFactory;
import fiji.plugin.trackmate.providers.DetectorProvider;
import fiji.plugin.trackmate.providers.SpotAnalyzerProvider;
import fiji.plugin.trackmate.providers.TrackerProvider;
import java.util.HashMap;
import java.util.Map;
import org.jdom2.Element;
import org.junit.jupiter.api.Test;

class ProvidersTest {
    @Test
    void trackMateFindsTheTracker() {
        TrackerProvider provider = new TrackerProvider();
        assertThat(provider.getVisibleKeys()).contains("MEMTRACK_SORT_TRACKER");
        assertThat(provider.getFactory("MEMTRACK_SORT_TRACKER")).isInstanceOf(MemtrackTrackerFactory.class);
    }

    @Test
    void trackMateFindsTheDetector() {
        DetectorProvider provider = new DetectorProvider();
        assertThat(provider.getVisibleKeys()).contains("MEMTRACK_DETECTOR");
        assertThat(provider.getFactory("MEMTRACK_DETECTOR")).isInstanceOf(SpotGlobalDetectorFactory.class);
    }

    @Test
    void theDetectorsDefaultsPassItsCheckAndComeBackFromXml() {
        survivesXml(new DetectorProvider().getFactory(MemtrackDetectorFactory.KEY), "DETECTOR_NAME");
    }

    @Test
    void trackMateFindsTheFeatures() {
        assertThat(new SpotAnalyzerProvider(1).getFactory(SpotFeatureAnalyzerFactory.KEY))
                .isInstanceOf(SpotFeatureAnalyzerFactory.class);
    }

    @Test
    void theTrackersDefaultsPassItsCheckAndComeBackFromXml() {
        survivesXml(new TrackerProvider().getFactory(MemtrackTrackerFactory.KEY), "TRACKER_NAME");
    }

    private static void survivesXml(TrackMateFactoryBase<?> factory, String nameAttribute) {
        Map<String, Object> defaults = factory.getDefaultSettings();
        assertThat(factory.checkSettings(defaults)).isNull();
        Element element = new Element("Settings").setAttribute(nameAttribute, factory.getKey());
        assertThat(factory.marshal(defaults, element)).isNull();
        Map<String, Object> read = new HashMap<>();
        assertThat(factory.unmarshal(element, read)).isNull();
        assertThat(read).isEqualTo(defaults);
        assertThat(factory.copy()).isNotSameAs(factory).hasSameClassAs(factory);
    }
}
