// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.TrackMateFactoryBase;
import fiji.plugin.trackmate.gui.components.ConfigurationPanel;
import fiji.plugin.trackmate.tracking.SpotImageTrackerFactory;
import fiji.plugin.trackmate.tracking.SpotTracker;
import fiji.plugin.trackmate.tracking.SpotTrackerFactory;
import ij.ImagePlus;
import java.util.Map;
import javax.swing.ImageIcon;
import org.jdom2.Element;
import org.jspecify.annotations.Nullable;
import org.scijava.Priority;
import org.scijava.plugin.Plugin;

/**
 * Offers SORT with interpolation among TrackMate's trackers.
 *
 * <p>Named here though it is implied, {@code TrackMateFactoryBase} keeps the class from loading in TrackMate 7, which then
 * leaves it out; half loaded, it would break that TrackMate's start.
 *
 * <p>It asks TrackMate for the image as well: the motion model is tuned in pixels, and spots know none.
 */
@Plugin(type = SpotTrackerFactory.class, priority = Priority.LOW)
public final class MemtrackTrackerFactory implements SpotImageTrackerFactory, TrackMateFactoryBase<SpotTrackerFactory> {
    /** Names the tracker in scripts and files. */
    public static final String KEY = "MEMTRACK_SORT_TRACKER";

    /** Names the tracker to the user. */
    public static final String NAME = "MEMTrack SORT tracker";

    @Override
    public SpotTracker create(SpotCollection spots, Map<String, Object> settings) {
        return new MemtrackTracker(spots, settings, null);
    }

    @Override
    public SpotTracker create(SpotCollection spots, Map<String, Object> settings, @Nullable ImagePlus image) {
        return new MemtrackTracker(spots, settings, image);
    }

    @Override
    public ConfigurationPanel getTrackerConfigurationPanel(Model model) {
        return new TrackerPanel(null);
    }

    @Override
    public ConfigurationPanel getTrackerConfigurationPanel(Model model, @Nullable ImagePlus image) {
        return new TrackerPanel(image);
    }

    @Override
    public Map<String, Object> getDefaultSettings() {
        return TrackerSettings.MAP.defaults();
    }

    @Override
    public @Nullable String checkSettings(@Nullable Map<String, Object> settings) {
        return TrackerSettings.check(settings);
    }

    @Override
    public @Nullable String marshal(Map<String, Object> settings, Element element) {
        return TrackerSettings.MAP.marshal(settings, element);
    }

    @Override
    public @Nullable String unmarshal(Element element, Map<String, Object> settings) {
        return TrackerSettings.MAP.unmarshal(element, settings);
    }

    @Override
    public MemtrackTrackerFactory copy() {
        return new MemtrackTrackerFactory();
    }

    @Override
    public ImageIcon getIcon() {
        return MemtrackIcon.LARGE;
    }

    @Override
    public String getInfoText() {
        return "<html>Joins the spots of any detector, one frame after the other: each track predicts where it goes on, and spots"
                + " are assigned to tracks by how swimmers move, or, as in the paper, by how much their boxes overlap the"
                + " predicted ones (SORT; without a box, the square around the spot's radius). <p>Where a track has no spot,"
                + " for a limited number of frames, it is interpolated: spots are added to the model, marked by the feature"
                + " &ldquo;Interpolated&rdquo;, so that they can be coloured and filtered. Running the tracker again replaces"
                + " them. <p>Films in one plane; no splitting, no merging. It needs no Python.</html>";
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
