// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;

/** TrackMate XML, version 7.14 of the format; TrackMate 7 and 8 open it with its image. */
public final class TrackMateXml {
    private TrackMateXml() {}

    /** Writes the tracks of a film, all or nothing. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        throw new UnsupportedOperationException("To come");
    }

    /**
     * Reads a file: versions 2.4 to 8.
     *
     * @throws FormatException when the file is not one of these
     */
    public static ImportedTracks read(Path source) throws IOException {
        throw new UnsupportedOperationException("To come");
    }
}
