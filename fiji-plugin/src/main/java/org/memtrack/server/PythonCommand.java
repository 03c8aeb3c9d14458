// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import java.util.stream.Stream;
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
     * @throws DetectorException when there is no Python that has MEMTrack, or the command does not end within half an
     *     hour, or it fails; then the message is its last line
     * @throws CancellationException when progress was cancelled
     */
    public static List<String> run(List<String> arguments, Progress progress) {
        return run(
                arguments,
                progress,
                Interpreters.candidates(null, System.getenv(), DataFolder.path()),
                Interpreter.ANSWER_LIMIT,
                LIMIT);
    }

    static List<String> run(
            List<String> arguments,
            Progress progress,
            List<Interpreter> candidates,
            Duration answerLimit,
            Duration limit) {
        List<String> command = new ArrayList<>(List.of("-m", "memtrack"));
        command.addAll(arguments);
        List<String> reasons = new ArrayList<>();
        for (Interpreter python : candidates) {
            Optional<String> objection = objection(python, progress, answerLimit);
            if (objection.isPresent()) {
                reasons.add("%s cannot be run: %s".formatted(python.describe(), objection.get()));
                continue;
            }
            try {
                WatchedProcess.End end =
                        WatchedProcess.run(python.process(command.toArray(String[]::new)), progress, line -> {}, limit);
                if (end.exitCode() == 0) {
                    return end.lines();
                }
                String last = end.lines().isEmpty()
                        ? "it ended with code " + end.exitCode()
                        : end.lines().get(end.lines().size() - 1);
                if (!last.contains(NOT_INSTALLED)) {
                    throw new DetectorException("memtrack %s failed: %s".formatted(arguments.get(0), last));
                }
                reasons.add(last);
            } catch (IOException e) {
                reasons.add("%s cannot be run: %s".formatted(python.describe(), e.getMessage()));
            } catch (TimeoutException e) {
                throw new DetectorException(
                        "memtrack %s %s and was stopped: close other programs and try again, or take a shorter film."
                                .formatted(arguments.get(0), e.getMessage()),
                        e);
            }
        }
        // The first is the likeliest to be meant.
        throw new DetectorException(
                ("No Python has MEMTrack (%s): run Plugins > Tracking > MEMTrack > MEMTrack Install Python Environment.")
                        .formatted(reasons.isEmpty() ? "No Python was found" : reasons.get(0)));
    }

    /** Why it is no Python that runs; a shim of pyenv or the stub of the Windows Store may say so, or wait. */
    private static Optional<String> objection(Interpreter python, Progress progress, Duration limit) {
        try {
            WatchedProcess.End end = WatchedProcess.run(python.process("-c", "pass"), progress, line -> {}, limit);
            return end.exitCode() == 0
                    ? Optional.empty()
                    : Stream.concat(end.lines().stream(), Stream.of("it ended with code " + end.exitCode()))
                            .filter(line -> !line.isBlank())
                            .findFirst();
        } catch (IOException | TimeoutException e) {
            return Optional.of(String.valueOf(e.getMessage()));
        }
    }
}
