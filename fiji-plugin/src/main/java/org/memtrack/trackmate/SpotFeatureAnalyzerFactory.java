// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Dimension;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.features.spot.SpotAnalyzer;
import fiji.plugin.trackmate.features.spot.SpotAnalyzerFactory;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import javax.swing.ImageIcon;
import net.imagej.ImgPlus;
import net.imglib2.type.NativeType;
import net.imglib2.type.numeric.RealType;
import org.jspecify.annotations.Nullable;
import org.memtrack.formats.SpotFeature;
import org.scijava.plugin.Plugin;

/**
 * Declares our features of spots to TrackMate, so that they are saved, coloured by, filtered by and listed in tables.
 *
 * <p>Their values come from the detector and the tracker. Only one is filled in here: a spot about which nobody said
 * otherwise, for example one drawn by hand, is not interpolated.
 *
 * <p>Of all our modules this one works in TrackMate 7, too.
 *
 * @param <T> type of the pixels, of no matter here
 */
@Plugin(type = SpotAnalyzerFactory.class)
public final class SpotFeatureAnalyzerFactory<T extends RealType<T> & NativeType<T>> implements SpotAnalyzerFactory<T> {
    /** Names the analyser in scripts and files. */
    public static final String KEY = "MEMTRACK_SPOT_FEATURES";

    /** Called by TrackMate when it starts; in one that is too old, the user reads so, once. */
    public SpotFeatureAnalyzerFactory() {
        TrackMateInstallation.tellProblemOnce();
    }

    @Override
    public SpotAnalyzer<T> getAnalyzer(ImgPlus<T> film, int frame, int channel) {
        return spots -> spots.forEach(SpotFeatureAnalyzerFactory::complete);
    }

    private static void complete(Spot spot) {
        if (spot.getFeature(SpotFeature.INTERPOLATED.key()) == null) {
            spot.putFeature(SpotFeature.INTERPOLATED.key(), 0.0);
        }
    }

    @Override
    public List<String> getFeatures() {
        return Arrays.stream(SpotFeature.values()).map(SpotFeature::key).toList();
    }

    @Override
    public Map<String, String> getFeatureShortNames() {
        return ofEach(SpotFeature::shortName);
    }

    @Override
    public Map<String, String> getFeatureNames() {
        return ofEach(SpotFeature::fullName);
    }

    @Override
    public Map<String, Dimension> getFeatureDimensions() {
        return ofEach(feature -> Dimension.valueOf(feature.dimension()));
    }

    @Override
    public Map<String, Boolean> getIsIntFeature() {
        return ofEach(SpotFeature::isInteger);
    }

    private static <V> Map<String, V> ofEach(Function<SpotFeature, V> property) {
        Map<String, V> map = new LinkedHashMap<>();
        for (SpotFeature feature : SpotFeature.values()) {
            map.put(feature.key(), property.apply(feature));
        }
        return map;
    }

    @Override
    public boolean isManualFeature() {
        return false;
    }

    @Override
    public String getKey() {
        return KEY;
    }

    @Override
    public String getName() {
        return "MEMTrack features";
    }

    @Override
    public String getInfoText() {
        return "Level, score, contrast and box of MEMTrack's detector, the drift of the stage it saw, and whether its tracker interpolated"
                + " the spot.";
    }

    @Override
    public @Nullable ImageIcon getIcon() {
        return null;
    }
}
