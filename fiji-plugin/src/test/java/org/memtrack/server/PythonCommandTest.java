// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Scripts in place of the Python package. */
@Timeout(60)
class PythonCommandTest {
    @TempDir
    Path folder;

    @Test
    void aCommandThatDoesNotEndIsNotTriedWithAnotherPython() throws Exception {
        Path other = folder.resolve("other");
        List<Interpreter> pythons = List.of(
                script("import sys, time; '-m' in sys.argv and time.sleep(60)"),
                script("open(r'%s', 'w').close()".formatted(other)));
        assertThatThrownBy(() -> run(pythons, Duration.ofSeconds(1)))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("memtrack evaluate did not end within 1 s and was stopped");
        assertThat(other).doesNotExist();
    }

    @Test
    void theFirstReasonIsTold() throws Exception {
        List<Interpreter> pythons = List.of(
                new Interpreter(List.of(folder.resolve("gone").toString()), "installed by MEMTrack", null),
                script("import sys; sys.exit('No module named memtrack')"));
        assertThatThrownBy(() -> run(pythons, Duration.ofMinutes(1)))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("No Python has MEMTrack")
                .hasMessageContaining("gone (installed by MEMTrack) cannot be run");
    }

    /** As a shim of pyenv for a version that is not selected, or the stub of the Windows Store. */
    @Test
    void aProgramThatRunsNoPythonIsPassedOver() throws Exception {
        Interpreter shim =
                script("import sys; print('pyenv: command not found\\n\\nNote: see its help'); sys.exit(127)");
        Interpreter python = script("print('done')");
        assertThat(run(List.of(shim, python), Duration.ofMinutes(1))).containsExactly("done");
        assertThatThrownBy(() -> run(List.of(shim), Duration.ofMinutes(1)))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("No Python has MEMTrack")
                .hasMessageContaining("(on the path) cannot be run: pyenv: command not found)");
    }

    @Test
    void aCommandThatFailsIsNotTriedWithAnotherPython() throws Exception {
        Path other = folder.resolve("other");
        List<Interpreter> pythons = List.of(
                script("import sys; sys.exit('-m' in sys.argv and 'there is no film')"),
                script("open(r'%s', 'w').close()".formatted(other)));
        assertThatThrownBy(() -> run(pythons, Duration.ofMinutes(1)))
                .isInstanceOf(DetectorException.class)
                .hasMessage("memtrack evaluate failed: there is no film");
        assertThat(other).doesNotExist();
    }

    /** As the stub of the Windows Store may, which waits for a window. */
    @Test
    void aProgramThatDoesNotAnswerIsNotGivenTheCommand() throws Exception {
        Path given = folder.resolve("given");
        Interpreter silent = script(
                "import sys, time; '-m' in sys.argv and open(r'%s', 'w').close(); time.sleep(60)".formatted(given));
        assertThatThrownBy(() -> PythonCommand.run(
                        List.of("evaluate"),
                        Progress.NONE,
                        List.of(silent),
                        Duration.ofSeconds(1),
                        Duration.ofMinutes(1)))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("No Python has MEMTrack")
                .hasMessageContaining("(on the path) cannot be run: did not end within 1 s)");
        assertThat(given).doesNotExist();
    }

    private static List<String> run(List<Interpreter> pythons, Duration limit) {
        return PythonCommand.run(List.of("evaluate"), Progress.NONE, pythons, Interpreter.ANSWER_LIMIT, limit);
    }

    private Interpreter script(String code) throws Exception {
        Path file = Files.writeString(Files.createTempFile(folder, "memtrack", ".py"), code);
        String python =
                Interpreters.onThisMachine(System.getenv()).get(0).command().get(0);
        return new Interpreter(List.of(python, file.toString()), "on the path", null);
    }
}
