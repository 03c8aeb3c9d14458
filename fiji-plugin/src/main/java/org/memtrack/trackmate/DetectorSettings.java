// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.util.LinkedHashMap;
import java.util.Map;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Thresholds;

/**
 * The detector's settings as TrackMate keeps them; keys never change, since files hold them.
 *
 * <p>Where the server is had from is not among them: a file from elsewhere must not name a program to start here.
 */
final class DetectorSettings {
    static final String MODEL = "MODEL";
    static final String MODEL_VERSION = "MODEL_VERSION";
    static final String THRESHOLDS = "THRESHOLDS";
    static final String THRESHOLD_LOW = "THRESHOLD_LOW";
    static final String THRESHOLD_MEDIUM = "THRESHOLD_MEDIUM";
    static final String THRESHOLD_HIGH = "THRESHOLD_HIGH";
    /** From 1; the key is TrackMate's own, so that the channel survives a change of detector. */
    static final String CHANNEL = "TARGET_CHANNEL";
    /** Cell length, greatest size and greatest overlap: 0 stands for not given. */
    static final String CELL_LENGTH = "CELL_LENGTH_PX";

    static final String MAXIMUM_SIZE = "MAXIMUM_SIZE_PX";
    static final String NMS_IOU = "NMS_IOU";
    static final String STABILISE = "STABILISE";
    static final String RESTING = "RESTING";

    static final SettingsMap MAP = new SettingsMap(MemtrackDetectorFactory.NAME, defaults());

    private DetectorSettings() {}

    /** Where the score thresholds come from. */
    enum ThresholdSource {
        MAXIMUM_PRECISION,
        MAXIMUM_F1,
        /** From the three settings. */
        GIVEN
    }

    private static Map<String, Object> defaults() {
        Map<String, Object> map = new LinkedHashMap<>();
        map.put(MODEL, "");
        map.put(MODEL_VERSION, "");
        map.put(THRESHOLDS, ThresholdSource.MAXIMUM_F1.name());
        map.put(THRESHOLD_LOW, 0.5);
        map.put(THRESHOLD_MEDIUM, 0.5);
        map.put(THRESHOLD_HIGH, 0.5);
        map.put(CHANNEL, 1);
        map.put(CELL_LENGTH, 0.0);
        map.put(MAXIMUM_SIZE, 0.0);
        map.put(NMS_IOU, 0.0);
        map.put(STABILISE, true);
        map.put(RESTING, false);
        return map;
    }

    /** One sentence when the map is not usable; null when it is. */
    static @Nullable String check(@Nullable Map<String, Object> map) {
        return MAP.check(map, settings -> {
            fromMap(settings);
            channel(settings);
        });
    }

    /** @throws IllegalArgumentException when the map is not usable */
    static DetectionSettings fromMap(Map<String, Object> map) {
        ThresholdSource source = SettingsMap.choice(ThresholdSource.class, THRESHOLDS, map);
        return new DetectionSettings(
                ((String) map.get(MODEL)).trim(),
                ((String) map.get(MODEL_VERSION)).trim(),
                source == ThresholdSource.MAXIMUM_F1 ? Criterion.MAXIMUM_F1 : Criterion.MAXIMUM_PRECISION,
                source == ThresholdSource.GIVEN
                        ? new Thresholds((Double) map.get(THRESHOLD_LOW), (Double) map.get(THRESHOLD_MEDIUM), (Double)
                                map.get(THRESHOLD_HIGH))
                        : null,
                given(map, MAXIMUM_SIZE),
                given(map, NMS_IOU),
                (Boolean) map.get(STABILISE),
                (Boolean) map.get(RESTING),
                given(map, CELL_LENGTH),
                null);
    }

    /**
     * The channel to use, from 0.
     *
     * @throws IllegalArgumentException when it is not one that an image can have
     */
    static int channel(Map<String, Object> map) {
        int channel = (Integer) map.get(CHANNEL);
        if (channel < 1) {
            throw new IllegalArgumentException("Channels are counted from 1, not " + channel);
        }
        return channel - 1;
    }

    private static @Nullable Double given(Map<String, Object> map, String key) {
        Double value = (Double) map.get(key);
        return value == 0 ? null : value;
    }
}
