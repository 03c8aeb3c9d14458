// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class StatusProgressTest {
    @ParameterizedTest
    @CsvSource({"0, 0 s", "0.2, 1 s", "99, 99 s", "99.5, 1:40 min", "605, 10:05 min"})
    void timeLeftIsRoundedUp(double seconds, String expected) {
        assertThat(StatusProgress.duration(seconds)).isEqualTo(expected);
    }
}
