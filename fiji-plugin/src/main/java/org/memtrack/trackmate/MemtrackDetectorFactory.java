// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.TrackMateFactoryBase;
import fiji.plugin.trackmate.detection.SpotDetectorFactory;
import fiji.plugin.trackmate.detection.SpotDetectorFactoryBase;
import fiji.plugin.trackmate.detection.SpotGlobalDetector;
import fiji.plugin.trackmate.detection.SpotGlobalDetectorFactory;
import fiji.plugin.trackmate.gui.components.ConfigurationPanel;
import java.util.Map;
import javax.swing.ImageIcon;
import net.imagej.ImgPlus;
import net.imglib2.Interval;
import net.imglib2.type.NativeType;
import net.imglib2.type.numeric.RealType;
import org.jdom2.Element;
import org.jspecify.annotations.Nullable;
import org.memtrack.server.ServerSettings;
import org.memtrack.server.Servers;
import org.scijava.Priority;
import org.scijava.plugin.Plugin;

/**
 * Offers the detector of bacteria and microrobots among TrackMate's detectors; a global one, since it needs the whole film.
 *
 * <p>For {@code TrackMateFactoryBase} see {@link MemtrackTrackerFactory}.
 *
 * @param <T> type of the pixels
 */
@Plugin(type = SpotDetectorFactory.class, priority = Priority.LOW)
public final class MemtrackDetectorFactory<T extends RealType<T> & NativeType<T>>
        implements SpotGlobalDetectorFactory<T>, TrackMateFactoryBase<SpotDetectorFactoryBase<T>> {
    /** Names the detector in scripts and files. */
    public static final String KEY = "MEMTRACK_DETECTOR";

    /** Names the detector to the user. */
    public static final String NAME = "MEMTrack detector";

    @Override
    public SpotGlobalDetector<T> getDetector(ImgPlus<T> image, Map<String, Object> settings, Interval interval) {
        return new MemtrackDetector<>(
                image, settings, interval, progress -> Servers.acquire(ServerSettings.DEFAULTS, progress));
    }

    @Override
    public ConfigurationPanel getDetectorConfigurationPanel(Settings settings, Model model) {
        return new DetectorPanel(settings, model);
    }

    @Override
    public Map<String, Object> getDefaultSettings() {
        return DetectorSettings.MAP.defaults();
    }

    @Override
    public @Nullable String checkSettings(@Nullable Map<String, Object> settings) {
        return DetectorSettings.check(settings);
    }

    @Override
    public @Nullable String marshal(Map<String, Object> settings, Element element) {
        return DetectorSettings.MAP.marshal(settings, element);
    }

    @Override
    public @Nullable String unmarshal(Element element, Map<String, Object> settings) {
        return DetectorSettings.MAP.unmarshal(element, settings);
    }

    @Override
    public boolean has2Dsegmentation() {
        return false;
    }

    @Override
    public MemtrackDetectorFactory<T> copy() {
        return new MemtrackDetectorFactory<>();
    }

    @Override
    public ImageIcon getIcon() {
        return MemtrackIcon.LARGE;
    }

    @Override
    public String getInfoText() {
        return "<html>Finds bacteria and microrobots in dense media of low contrast by how they move: every frame is compared"
                + " with the film's background, and a small neural network, trained on such films, looks at the result."
                + " <p>It needs the whole film, so there is no detection in a single frame; the preview looks at the frames"
                + " around the current one. <p>The network runs in a local Python, which MEMTrack starts and ends by itself."
                + " Spots carry the detector's level, score and box as features.</html>";
    }

    @Override
    public String getKey() {
        return KEY;
    }

    @Override
    public String getName() {
        return NAME;
    }

    @Override
    public String toString() {
        return NAME;
    }
}
