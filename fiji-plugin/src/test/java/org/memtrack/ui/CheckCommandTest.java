// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.memtrack.server.ServerSettings;

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

    @Test
    void aPathFromTheClipboardOfWindowsIsAPath() {
        assertThat(CheckCommand.settings("python=[\"/my programs/python\"]").python())
                .isEqualTo(Path.of("/my programs/python"));
        assertThat(CheckCommand.settings(null)).isEqualTo(ServerSettings.DEFAULTS);
    }
}
