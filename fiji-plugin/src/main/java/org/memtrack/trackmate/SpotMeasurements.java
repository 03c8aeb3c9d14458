// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.features.spot.SpotAnalyzerFactory;
import fiji.plugin.trackmate.providers.SpotAnalyzerProvider;
import fiji.plugin.trackmate.util.TMUtils;
import ij.ImagePlus;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Collectors;
import net.imagej.ImgPlus;
import org.jspecify.annotations.Nullable;

/**
 * Measures spots that are added after TrackMate measured the others.
 *
 * <p>TrackMate computes the features of spots before it tracks them; without this, a filter on, say, the mean intensity
 * would meet spots that have none.
 */
final class SpotMeasurements {
    private SpotMeasurements() {}

    /**
     * Gives new spots the features that the observed ones have.
     *
     * @param added spots whose frame is set
     * @param observed spots that TrackMate may have measured
     * @param image they lie in; without it nothing is done, as in TrackMate
     */
    @SuppressWarnings({"rawtypes", "unchecked"})
    static void complete(Collection<Spot> added, Collection<Spot> observed, @Nullable ImagePlus image) {
        if (image == null || added.isEmpty() || observed.isEmpty()) {
            return;
        }
        Spot example = observed.iterator().next();
        Map<Integer, List<Spot>> byFrame =
                added.stream().collect(Collectors.groupingBy(Spots::frame, TreeMap::new, Collectors.toList()));
        ImgPlus film = TMUtils.rawWraps(image);
        SpotAnalyzerProvider provider = new SpotAnalyzerProvider(image.getNChannels());
        for (String key : provider.getKeys()) {
            SpotAnalyzerFactory factory = provider.getFactory(key);
            List<String> features = factory.getFeatures();
            if (factory.isManualFeature()
                    || features.stream().noneMatch(feature -> example.getFeature(feature) != null)) {
                continue;
            }
            byFrame.forEach((frame, spots) -> {
                for (int channel = 0; channel < image.getNChannels(); channel++) {
                    factory.getAnalyzer(film, frame, channel).process(spots);
                }
            });
        }
    }
}
