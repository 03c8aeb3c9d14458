// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import org.memtrack.detection.DetectorException;

/** A path that an environment variable holds. */
final class VariablePath {
    private VariablePath() {}

    /** @throws DetectorException when what the variable holds cannot be a path on this system */
    static Path of(String variable, String value) {
        try {
            return Path.of(value);
        } catch (InvalidPathException e) {
            throw new DetectorException(
                    "The variable %s is \"%s\", which is no path (%s): correct or remove it, then restart ImageJ."
                            .formatted(variable, value, e.getReason()),
                    e);
        }
    }
}
