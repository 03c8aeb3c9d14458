// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class SortSettingsTest {

    @Test
    void thePresetsDifferInTheLeastLengthOnly() {
        assertThat(SortSettings.COLLAGEN.filter().minimumLength()).isEqualTo(60);
        assertThat(SortSettings.WATER).isEqualTo(SortSettings.COLLAGEN.with(TrackFilter.ofSwimmers(30)));
    }

    @Test
    void valuesOutOfRangeAreNamed() {
        assertThatThrownBy(() -> new SortSettings(
                        Association.OVERLAP, Double.NaN, 25, 0, Interpolation.AUTHORS, false, TrackFilter.ofLength(60)))
                .hasMessage("The IoU gate must lie in [0, 1), not NaN");
        assertThatThrownBy(() -> new SortSettings(
                        Association.OVERLAP, 0.05, -1, 0, Interpolation.AUTHORS, false, TrackFilter.ofLength(60)))
                .hasMessage("The maximum age must be at least 0, not -1");
        assertThatThrownBy(() -> new SortSettings(
                        Association.OVERLAP, 0.05, 25, -2, Interpolation.AUTHORS, false, TrackFilter.ofLength(60)))
                .hasMessage("The minimum hits must be at least 0, not -2");
        assertThatThrownBy(() -> SortSettings.DEFAULTS.with(TrackFilter.ofLength(0)))
                .hasMessage("The minimum track length must be at least 1, not 0");
    }
}
