// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;

class CheckCommandTest {
    @Test
    void whatToDoAboutAServerThatFailsIsInLinesOfTheWindow() {
        String sentence = "The server's Python environment is not installed yet: run Plugins > Tracking > MEMTrack >"
                + " MEMTrack Install Python Environment.";
        String lines = CheckCommand.problem(sentence);
        assertThat(lines.lines()).hasSize(2).allSatisfy(line -> assertThat(line).hasSizeLessThanOrEqualTo(80));
        assertThat(lines.strip().replace('\n', ' ')).isEqualTo("Server: " + sentence);
        assertThat(lines).endsWith("\n");
    }
}
