// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.plugin.frame.Recorder;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.detection.DetectorException;

class CommandOptionsTest {
    @Test
    void anOptionThatACommandDoesNotKnowIsToldWithThoseItKnows() {
        refuses(
                () -> OpenInTrackMateCommand.given("fil=[/a/b.xml]"),
                "\"fil\"",
                "MEMTrack Open in TrackMate: give only file.");
        refuses(() -> CheckCommand.settings("pyton=x"), "\"pyton\"", "give only python and server.");
        refuses(() -> InstallCommand.options("python=x troch"), "\"troch\"", "give only python and torch.");
        assertThat(InstallCommand.options("python=x torch"))
                .hasValueSatisfying(options ->
                        assertThat(options).containsEntry("python", "x").containsEntry("torch", "true"));
    }

    @Test
    void theFileToOpenInTrackMateMustBeGivenAndThere(@TempDir Path folder) throws Exception {
        Path tracks = Files.createFile(folder.resolve("my tracks.xml"));
        assertThat(OpenInTrackMateCommand.given("file=[%s]".formatted(tracks))).isEqualTo(tracks);
        refuses(() -> OpenInTrackMateCommand.given(""), "No file of tracks is given: give file=");
        refuses(() -> OpenInTrackMateCommand.given("file=[%s]".formatted(folder)), "There is no file " + folder);
    }

    @Test
    void theFileChosenInTheDialogIsRecordedAsWhatTheMacroReads() {
        Recorder.setCommand("MEMTrack Open in TrackMate");
        // What the dialog does while macros are recorded.
        Recorder.recordPath(OpenInTrackMateCommand.QUESTION, "/my films/tracks.xml");
        assertThat(Recorder.getCommandOptions()).isEqualTo("file=[/my films/tracks.xml]");
        Recorder.setCommand(null);
    }

    @Test
    void whatIsRecordedDoesNotWaitForTheEndOfTheCommand() {
        boolean before = Recorder.record;
        Recorder.record = true;
        try {
            RecordedLine.write(Map.of("output", "/my films/out"));
            assertThat(Recorder.getCommandOptions())
                    .as("what another command would lose or get")
                    .isNull();
        } finally {
            Recorder.record = before;
        }
    }

    private static void refuses(ThrowingCallable work, String... parts) {
        assertThatThrownBy(work)
                .isInstanceOf(DetectorException.class)
                .message()
                .contains(parts)
                .endsWith(".");
    }
}
