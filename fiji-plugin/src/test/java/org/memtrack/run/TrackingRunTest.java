// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Thresholds;
import org.memtrack.macro.TrackOption;
import org.memtrack.server.ServerSettings;
import org.memtrack.tracking.SortSettings;

class TrackingRunTest {
    @Test
    void whereNoTrackIsLeftTheFieldsOfTheDialogAndTheKeysAreNamed() {
        assertThat(TrackingRun.noTracks(9, of(DetectionSettings.DEFAULTS, SortSettings.WATER)))
                .contains("30 frames", "0.3")
                .contains(TrackOption.MIN_LENGTH.bothNames(), TrackOption.MIN_SCORE.bothNames());
    }

    @Test
    void maximumF1IsOfferedToThoseWhoChoseMaximumPrecision() {
        assertThat(TrackingRun.noTracks(0, detecting(Criterion.MAXIMUM_PRECISION, null)))
                .startsWith("Nothing was detected: choose maximum F1 in " + TrackOption.CRITERION.bothNames());
        assertThat(TrackingRun.noTracks(0, of(DetectionSettings.DEFAULTS, SortSettings.DEFAULTS)))
                .contains("lower the thresholds")
                .doesNotContain("F1");
        assertThat(TrackingRun.noTracks(0, detecting(Criterion.MAXIMUM_PRECISION, new Thresholds(0.7, 0.8, 0.9))))
                .contains("lower the thresholds")
                .contains(TrackOption.PIXEL_SIZE.bothNames(), TrackOption.CELL_LENGTH.bothNames())
                .doesNotContain("F1");
    }

    private static TrackingSettings detecting(Criterion criterion, Thresholds thresholds) {
        return of(
                new DetectionSettings("", "", criterion, thresholds, null, null, true, false, null, null),
                SortSettings.DEFAULTS);
    }

    private static TrackingSettings of(DetectionSettings detection, SortSettings tracking) {
        return new TrackingSettings(detection, tracking, ServerSettings.DEFAULTS, true);
    }
}
