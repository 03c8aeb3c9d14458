// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.TimeoutException;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Finds a Python of this machine to make an environment with. */
final class BasePython {
    /** Oldest that the server's package takes. */
    private static final int LEAST_MINOR = 11;

    private static final String QUESTION =
            "import sys; print('python', sys.version_info[0], sys.version_info[1], sys.maxsize > 2**32);"
                    + " import ensurepip, venv; print('complete')";

    private BasePython() {}

    /**
     * The first of the candidates that can make an environment; empty when there is none.
     *
     * @param objections gets what is wrong with each before
     */
    static Optional<Interpreter> choose(List<Interpreter> candidates, List<String> objections, Progress progress) {
        for (Interpreter candidate : candidates) {
            String objection = objection(candidate, progress);
            if (objection.isEmpty()) {
                return Optional.of(candidate);
            }
            objections.add(candidate.describe() + " " + objection);
        }
        return Optional.empty();
    }

    /** That there is none, with what is wrong with those that were tried, and what to do. */
    static DetectorException none(List<String> objections) {
        return new DetectorException("No Python 3.%d or newer was found%s: %s, then run this command again."
                .formatted(
                        LEAST_MINOR,
                        objections.isEmpty() ? "" : " (" + String.join("; ", objections) + ")",
                        CarriedPython.advice()));
    }

    private static String objection(Interpreter candidate, Progress progress) {
        WatchedProcess.End end;
        try {
            end = WatchedProcess.run(candidate.process("-c", QUESTION), progress, line -> {}, Interpreter.ANSWER_LIMIT);
        } catch (IOException | TimeoutException e) {
            return "cannot be run: " + e.getMessage();
        }
        String[] said = end.lines().stream()
                .filter(line -> line.startsWith("python "))
                .findFirst()
                .orElse("")
                .split(" ");
        if (said.length != 4) {
            return "is no Python";
        }
        if (!said[1].equals("3") || Integer.parseInt(said[2]) < LEAST_MINOR) {
            return "is too old: " + said[1] + "." + said[2];
        }
        if (!said[3].equals("True")) {
            return "is a 32-bit one";
        }
        return end.lines().contains("complete") ? "" : "lacks venv: install the package python3-venv";
    }
}
