// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A Python to start the server with.
 *
 * @param command program and its first arguments, for example "py" and "-3"
 * @param origin why it was chosen, for the user, for example "of MEMTRACK_PYTHON"
 * @param environment the environment of ours it belongs to, which the user's Python settings must not reach into; null
 *     when it is a Python of the user's
 */
record Interpreter(
        List<String> command, String origin, @Nullable PythonEnvironment environment) {
    /** Within which one answers a question; the stub of the Windows Store may wait for a window instead. */
    static final Duration ANSWER_LIMIT = Duration.ofSeconds(20);

    Interpreter {
        command = List.copyOf(command);
    }

    /** As the user may read it. */
    String describe() {
        return String.join(" ", command) + " (" + origin + ")";
    }

    /** A builder for a process of this Python with further arguments; its environment fits this Python. */
    ProcessBuilder process(String... arguments) {
        List<String> all = new ArrayList<>(command);
        all.addAll(List.of("-X", "utf8"));
        all.addAll(List.of(arguments));
        ProcessBuilder builder = new ProcessBuilder(all);
        builder.environment().put("PYTHONUNBUFFERED", "1");
        // A file in the working folder must not pass for a module (Python 3.11 and newer).
        builder.environment().put("PYTHONSAFEPATH", "1");
        if (environment != null) {
            builder.environment().remove("PYTHONPATH");
            builder.environment().remove("PYTHONHOME");
            builder.environment().put("PYTHONNOUSERSITE", "1");
        }
        return builder;
    }
}
