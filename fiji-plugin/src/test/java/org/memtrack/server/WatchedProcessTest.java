// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.EnabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;

/** Real processes of the Python on the path. */
@Timeout(60)
class WatchedProcessTest {
    /** Leaves its number in a file and works on; it takes a while to give its memory back. */
    private static final String WORK = """
            import os, sys, time
            memory = b"x" * 300_000_000
            open(sys.argv[1] + ".new", "w").write(str(os.getpid()))
            os.rename(sys.argv[1] + ".new", sys.argv[1])
            time.sleep(60)
            """;

    /** Starts the real program and waits for it, as the python of a venv does on Windows. */
    private static final String LAUNCHER =
            "import subprocess, sys; subprocess.run([sys.executable, '-c', sys.argv[1], sys.argv[2]])";

    /** Gets orphans as the first process of a container does, and reaps none of them. */
    private static final String CONTAINER = """
            import ctypes, subprocess, sys
            SUBREAPER = 36
            assert ctypes.CDLL(None).prctl(SUBREAPER, 1, 0, 0, 0) == 0
            sys.exit(subprocess.call(sys.argv[1:]))
            """;

    @TempDir
    Path folder;

    @Test
    void aCancelledProgramHasEndedWithTheChildrenItStarted() throws Exception {
        Path pid = folder.resolve("pid");
        ProcessBuilder program = python().process("-c", LAUNCHER, WORK, pid.toString());
        assertThatThrownBy(() -> WatchedProcess.run(
                        program, cancelledWhen(() -> Files.exists(pid)), line -> {}, Duration.ofMinutes(1)))
                .isInstanceOf(CancellationException.class);
        assertThat(running(pid)).isEmpty();
    }

    @Test
    void aProgramEndsWithImageJ() throws Exception {
        Path pid = folder.resolve("pid");
        List<String> command = java(QuittingProgram.class);
        command.addAll(python().process("-c", WORK, pid.toString()).command());
        Process imageJ = new ProcessBuilder(command).inheritIO().start();
        assertThat(imageJ.waitFor()).isZero();
        assertThat(running(pid)).isEmpty();
    }

    @Test
    @EnabledOnOs(OS.LINUX)
    void noTimeIsLostWhereNobodyReapsTheChildrenOfACancelledProgram() throws Exception {
        Path pid = folder.resolve("pid");
        Path log = folder.resolve("log");
        List<String> command = new ArrayList<>(python().process("-c", CONTAINER).command());
        command.addAll(java(CancellingProgram.class));
        command.addAll(python().process("-c", LAUNCHER, WORK, pid.toString()).command());
        Process container = new ProcessBuilder(command)
                .redirectErrorStream(true)
                .redirectOutput(log.toFile())
                .start();
        assertThat(container.waitFor()).as(Files.readString(log)).isZero();
        assertThat(log).content().contains("Cancelled").doesNotContain("Still running");
        assertThat(running(pid)).isEmpty();
    }

    @Test
    void nothingIsHeardOfACancelledProgramAnyMore() throws Exception {
        ProcessBuilder program = python().process("-c", "while True: print('more')");
        AtomicInteger heard = new AtomicInteger();
        Consumer<String> slow = line -> {
            heard.incrementAndGet();
            LockSupport.parkNanos(1_000_000); // what waits in the pipe would keep it busy for many seconds
        };
        assertThatThrownBy(() -> WatchedProcess.run(
                        program, cancelledWhen(() -> heard.get() > 100), slow, Duration.ofMinutes(1)))
                .isInstanceOf(CancellationException.class);
        int heardAtTheEnd = heard.get();
        Thread.sleep(200);
        assertThat(heard).hasValue(heardAtTheEnd);
    }

    private static Optional<ProcessHandle> running(Path pid) throws IOException {
        return ProcessHandle.of(Long.parseLong(Files.readString(pid)))
                .filter(ProcessHandle::isAlive)
                .filter(process -> !isZombie(process));
    }

    /** It has ended, but nobody has asked for its exit code; on Linux only. */
    private static boolean isZombie(ProcessHandle process) {
        try {
            // The state follows the name, which stands in brackets and may hold anything.
            String stat = Files.readString(Path.of("/proc", Long.toString(process.pid()), "stat"));
            return stat.substring(stat.lastIndexOf(')')).startsWith(") Z");
        } catch (IOException e) {
            return false;
        }
    }

    /** What starts a program of these tests in a Java of its own; its arguments are to be added. */
    private static List<String> java(Class<?> program) {
        return new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                "-cp",
                System.getProperty("java.class.path"),
                program.getName()));
    }

    private static Interpreter python() {
        return Interpreters.onThisMachine(System.getenv()).get(0);
    }

    private static Progress cancelledWhen(BooleanSupplier enough) {
        return new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

            @Override
            public boolean cancelled() {
                return enough.getAsBoolean();
            }
        };
    }
}
