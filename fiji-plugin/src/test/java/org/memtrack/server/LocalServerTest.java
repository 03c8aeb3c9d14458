// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Programs that are no server, or no good one, in place of {@code python -m memtrack serve}. */
@Timeout(600)
class LocalServerTest {
    @TempDir
    Path folder;

    @Test
    void aProgramThatFailsIsReportedWithItsLastWords() throws Exception {
        Interpreter broken = script("import sys; print('loading', file=sys.stderr); sys.exit('numpy is broken')");
        assertThatThrownBy(() -> LocalServer.start(broken, Progress.NONE))
                .isInstanceOf(StartException.class)
                .hasMessageEndingWith("ended: numpy is broken");
    }

    @Test
    void aShimOfPyenvIsReportedWithWhatItSaysFirst() throws Exception {
        Interpreter shim = script("""
                import sys
                sys.exit("pyenv: python3.12: command not found\\n\\nThe `python3.12' command exists in these Python versions:"
                         "\\n  3.12.1\\n\\nNote: See 'pyenv help global' for tips on allowing multiple\\n      Python versions.")
                """);
        assertThatThrownBy(() -> LocalServer.start(shim, Progress.NONE))
                .isInstanceOf(StartException.class)
                .hasMessageEndingWith("ended: pyenv: python3.12: command not found");
    }

    @Test
    void aProgramThatSaysSomethingElseIsNoServer() throws Exception {
        Interpreter other = script("print('Hello', flush=True)");
        assertThatThrownBy(() -> LocalServer.start(other, Progress.NONE))
                .isInstanceOf(StartException.class)
                .hasMessageContaining("\"Hello\"");
    }

    @Test
    void aProgramThatNeverBecomesReadyIsToldSo() throws Exception {
        Interpreter silent = script("import sys; print('loading', file=sys.stderr, flush=True); sys.stdin.read()");
        assertThatThrownBy(() -> LocalServer.start(silent, Progress.NONE, Duration.ofSeconds(1)))
                .isInstanceOf(StartException.class)
                .hasMessageEndingWith("did not start within 1 s: loading");
    }

    @Test
    void anAccountWhoseHomeIsNoFolderStartsAServerToo() throws Exception {
        Interpreter serving = script(SmallWheel.SERVER);
        String home = System.getProperty("user.home");
        System.setProperty("user.home", folder.resolve("nonexistent").toString());
        try {
            LocalServer server = LocalServer.start(serving, Progress.NONE);
            assertThat(server.alive()).isTrue();
            server.end();
        } finally {
            System.setProperty("user.home", home);
        }
    }

    @Test
    void aProgramThatDoesNotExistIsNoServer() {
        Interpreter missing = new Interpreter(List.of(folder.resolve("python").toString()), "as given", null);
        assertThatThrownBy(() -> LocalServer.start(missing, Progress.NONE))
                .isInstanceOf(StartException.class)
                .hasMessageContaining("could not be run");
    }

    @Test
    void aServerOfAnotherProtocolIsRefusedWithBothVersions() throws Exception {
        Interpreter newer = script("""
                import json, sys
                print(json.dumps({"protocol": 7, "port": 1, "pid": 1, "version": "3.0.0"}), flush=True)
                sys.stdin.read()
                """);
        assertThatThrownBy(() -> LocalServer.start(newer, Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("3.0.0")
                .hasMessageContaining("version 7")
                .hasMessageContaining("version 1");
    }

    @Test
    void cancellingWhileItStartsEndsTheProcess() throws Exception {
        Path pid = folder.resolve("pid");
        Interpreter slow = script(
                "import os, sys, time; open(%s, 'w').write(str(os.getpid())); sys.stdin.read()".formatted(quoted(pid)));
        Progress cancelledWhenRunning = new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

            @Override
            public boolean cancelled() {
                return pid.toFile().length() > 0;
            }
        };
        assertThatThrownBy(() -> LocalServer.start(slow, cancelledWhenRunning))
                .isInstanceOf(CancellationException.class);
        assertThat(ProcessHandle.of(Long.parseLong(Files.readString(pid))).filter(ProcessHandle::isAlive))
                .isEmpty();
    }

    @Test
    void allReasonsAreToldWhenNoPythonCanServe() throws Exception {
        ManagedServer managed = new ManagedServer(Duration.ofMinutes(1), Optional::empty);
        List<Interpreter> candidates = List.of(
                script("import sys; sys.exit('first reason')"), script("import sys; sys.exit('second reason')"));
        assertThatThrownBy(() -> managed.acquire(candidates, Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("first reason")
                .hasMessageContaining("second reason")
                .hasMessageContaining("Install Python Environment");
        assertThatThrownBy(() -> managed.acquire(List.of(), Progress.NONE))
                .hasMessageContaining("Install Python Environment");
    }

    @Test
    void withoutAnyPythonItIsToldWhatToDoFirst() {
        assertThat(ManagedServer.noPython(Optional.empty()))
                .startsWith("No Python was found: install Python 3.11 or newer")
                .contains(CarriedPython.advice())
                .endsWith("MEMTrack Install Python Environment.");
        assumeTrue(
                CarriedPython.find().isPresent(), "The jar with a Python that the tests fetch is for Linux on x86_64.");
        assertThat(ManagedServer.noPython(CarriedPython.find()))
                .isEqualTo("The server's Python environment is not installed yet: run Plugins > Tracking > MEMTrack >"
                        + " MEMTrack Install Python Environment.");
    }

    private Interpreter script(String code) throws Exception {
        Path file = Files.createTempFile(folder, "server", ".py");
        Files.writeString(file, code);
        String python = Interpreters.onThisMachine(System.getenv()).stream()
                .map(found -> found.command().get(0))
                .findFirst()
                .orElseThrow(() -> new AssertionError("These tests need Python on the path"));
        return new Interpreter(List.of(python, file.toString()), "as given", null);
    }

    private static String quoted(Path path) {
        return "r'" + path + "'";
    }
}
