// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.DetectorException;

class GivenPathTest {
    @Test
    void quotesAroundAPathAreTakenAway() {
        assertThat(GivenPath.of(" \"/my films/ü [1]\" ")).isEqualTo(Path.of("/my films/ü [1]"));
        assertThat(GivenPath.of("/a\"b")).isEqualTo(Path.of("/a\"b"));
    }

    @Test
    void whatIsNoPathIsToldInOneSentence() {
        assertThatThrownBy(() -> GivenPath.of("/a\0b"))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("/a\0b")
                .hasMessageEndingWith("give another one.");
    }
}
