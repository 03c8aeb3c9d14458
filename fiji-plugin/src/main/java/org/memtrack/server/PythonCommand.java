// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Runs a command of the Python package for work that is not the server's, for example an evaluation. */
public final class PythonCommand {
    private static final Duration LIMIT = Duration.ofMinutes(30);
    private static final String NOT_INSTALLED = "No module named";

    private PythonCommand() {}

    /**
     * Runs {@code memtrack} with the arguments, in the Python that a server of our own would be started with.
     *
     * @param arguments the command's name first
     * @param progress asked whether to go on
     * @return the lines it printed last
     * @throws DetectorException when there is no Python that has MEMTrack, or the command fails; the message is its last line
     * @throws CancellationException when progress was cancelled
     */
    public static List<String> run(List<String> arguments, Progress progress) {
        String last = "No Python was found";
        for (Interpreter python : Interpreters.candidates(null, System.getenv(), DataFolder.path())) {
            List<String> command = new ArrayList<>(List.of("-m", "memtrack"));
            command.addAll(arguments);
            try {
                WatchedProcess.End end =
                        WatchedProcess.run(python.process(command.toArray(String[]::new)), progress, line -> {}, LIMIT);
                if (end.exitCode() == 0) {
                    return end.lines();
                }
                last = end.lines().isEmpty()
                        ? "it ended with code " + end.exitCode()
                        : end.lines().get(end.lines().size() - 1);
                if (!last.contains(NOT_INSTALLED)) {
                    throw new DetectorException("memtrack %s failed: %s".formatted(arguments.get(0), last));
                }
            } catch (IOException e) {
                last = "%s cannot be run: %s".formatted(python.describe(), e.getMessage());
            }
        }
        throw new DetectorException(
                ("No Python has MEMTrack (%s): run Plugins > Tracking > MEMTrack > MEMTrack Install Python Environment.")
                        .formatted(last));
    }
}
