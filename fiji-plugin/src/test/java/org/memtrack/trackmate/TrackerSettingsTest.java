// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Map;
import org.junit.jupiter.api.Test;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.TrackFilter;

class TrackerSettingsTest {
    private static final SortSettings OTHERS =
            new SortSettings(Association.MOTION, 0.3, 11, 2, Interpolation.AUTHORS, false, new TrackFilter(13, 7, 0.2));

    @Test
    void settingsSurviveTheMap() {
        assertThat(TrackerSettings.fromMap(TrackerSettings.toMap(OTHERS))).isEqualTo(OTHERS);
        SortSettings defaults = TrackerSettings.fromMap(TrackerSettings.MAP.defaults());
        assertThat(defaults.smooth())
                .as("spots stay where their detector put them")
                .isFalse();
        assertThat(defaults).usingRecursiveComparison().ignoringFields("smooth").isEqualTo(SortSettings.DEFAULTS);
    }

    @Test
    void settingsSurviveThePanel() {
        TrackerPanel panel = new TrackerPanel(null);
        assertThat(panel.getSettings()).isEqualTo(TrackerSettings.MAP.defaults());
        panel.setSettings(TrackerSettings.toMap(OTHERS));
        assertThat(panel.getSettings()).isEqualTo(TrackerSettings.toMap(OTHERS));
    }

    @Test
    void aShortFilmIsAdvisedTheLengthThatTheMenuTakesByItself() {
        assertThat(TrackerPanel.lengthAdvice(120)).isEqualTo("This film has 120 frames.");
        assertThat(TrackerPanel.lengthAdvice(119))
                .isEqualTo("This film has only 119 frames: a least track length of 59 or less suits it.");
    }

    @Test
    void aValueOutOfRangeIsNamedInOneSentence() {
        Map<String, Object> map = TrackerSettings.MAP.defaults();
        assertThat(TrackerSettings.check(map)).isNull();
        map.put("MAXIMUM_AGE", -4);
        assertThat(TrackerSettings.check(map)).isEqualTo("The maximum age must be at least 0, not -4.");
        map.put("MAXIMUM_AGE", 4);
        map.put("INTERPOLATION", "CUBIC");
        assertThat(TrackerSettings.check(map))
                .isEqualTo("The setting INTERPOLATION must be FILL_GAPS or AUTHORS, not \"CUBIC\".");
    }
}
