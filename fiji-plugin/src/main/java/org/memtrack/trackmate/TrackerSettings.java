// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.util.LinkedHashMap;
import java.util.Map;
import org.jspecify.annotations.Nullable;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.TrackFilter;

/** The tracker's settings as TrackMate keeps them; keys never change, since files hold them. */
final class TrackerSettings {
    static final String ASSOCIATION = "ASSOCIATION";
    static final String IOU_GATE = "IOU_GATE";
    static final String MAXIMUM_AGE = "MAXIMUM_AGE";
    static final String MINIMUM_HITS = "MINIMUM_HITS";
    static final String INTERPOLATION = "INTERPOLATION";
    static final String MINIMUM_TRACK_LENGTH = "MINIMUM_TRACK_LENGTH";
    static final String MINIMUM_TRACK_LENGTH_IF_SURE = "MINIMUM_TRACK_LENGTH_IF_SURE";
    static final String MINIMUM_TRACK_SCORE = "MINIMUM_TRACK_SCORE";

    static final SettingsMap MAP = new SettingsMap(MemtrackTrackerFactory.NAME, toMap(SortSettings.DEFAULTS));

    private TrackerSettings() {}

    static Map<String, Object> toMap(SortSettings settings) {
        Map<String, Object> map = new LinkedHashMap<>();
        map.put(ASSOCIATION, settings.association().name());
        map.put(IOU_GATE, settings.iouGate());
        map.put(MAXIMUM_AGE, settings.maximumAge());
        map.put(MINIMUM_HITS, settings.minimumHits());
        map.put(INTERPOLATION, settings.interpolation().name());
        map.put(MINIMUM_TRACK_LENGTH, settings.filter().minimumLength());
        map.put(MINIMUM_TRACK_LENGTH_IF_SURE, settings.filter().minimumLengthIfSure());
        map.put(MINIMUM_TRACK_SCORE, settings.filter().minimumScore());
        return map;
    }

    /** One sentence when the map is not usable; null when it is. */
    static @Nullable String check(@Nullable Map<String, Object> map) {
        return MAP.check(map, TrackerSettings::fromMap);
    }

    /** @throws IllegalArgumentException when the map is not usable */
    static SortSettings fromMap(Map<String, Object> map) {
        return new SortSettings(
                SettingsMap.choice(Association.class, ASSOCIATION, map),
                (Double) map.get(IOU_GATE),
                (Integer) map.get(MAXIMUM_AGE),
                (Integer) map.get(MINIMUM_HITS),
                SettingsMap.choice(Interpolation.class, INTERPOLATION, map),
                false, // spots stay where their detector put them
                new TrackFilter(
                        (Integer) map.get(MINIMUM_TRACK_LENGTH),
                        (Integer) map.get(MINIMUM_TRACK_LENGTH_IF_SURE),
                        (Double) map.get(MINIMUM_TRACK_SCORE)));
    }
}
