// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;

/** The Python with the model server that the tests are run with. */
final class Python {
    private Python() {}

    static String path() {
        String path = System.getenv("MEMTRACK_PYTHON");
        if (path == null) {
            throw new AssertionError(
                    "Set MEMTRACK_PYTHON to a Python that has the model server, or run the tests with the"
                            + " command of the README");
        }
        return path;
    }

    /** Simulates a film of swimmers in water; the same every time. */
    static void simulate(Path film, int seed, int frames, int width, int height)
            throws IOException, InterruptedException {
        List<String> command = new ArrayList<>(List.of(path(), "-m", "memtrack", "simulate", film.toString()));
        command.addAll(List.of("--family", "water", "--seed", Integer.toString(seed)));
        command.addAll(List.of("--frames", Integer.toString(frames)));
        command.addAll(List.of("--width", Integer.toString(width), "--height", Integer.toString(height)));
        Process process = new ProcessBuilder(command)
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.DISCARD)
                .start();
        if (!process.waitFor(60, TimeUnit.SECONDS) || process.exitValue() != 0) {
            process.destroyForcibly();
            throw new AssertionError("Simulating failed: " + command);
        }
    }
}
