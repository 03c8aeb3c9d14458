// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;

/** MTrackJ data files (.mdf). */
public final class Mdf {
    private Mdf() {}

    /** Writes the tracks of a film, all or nothing. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        throw new UnsupportedOperationException("To come");
    }

    /**
     * Reads a file: every dialect from version 1.0.
     *
     * @throws FormatException when the file is not one of these
     */
    public static ImportedTracks read(Path source) throws IOException {
        throw new UnsupportedOperationException("To come");
    }
}
