// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import org.memtrack.detection.DetectorException;

/** A path as a user types it or pastes it. */
public final class GivenPath {
    private GivenPath() {}

    /**
     * The path of a text, without the quotes that "Copy as path" of Windows puts around it.
     *
     * @throws DetectorException when it is no path
     */
    public static Path of(String text) {
        String path = text.strip().replaceFirst("^\"(.*)\"$", "$1");
        try {
            return Path.of(path);
        } catch (InvalidPathException e) {
            throw new DetectorException("\"%s\" is no path (%s): give another one.".formatted(path, e.getReason()), e);
        }
    }
}
