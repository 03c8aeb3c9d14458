// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;

/** CSV: one header row, one row a point. */
public final class TrackCsv {
    private TrackCsv() {}

    /** Writes the tracks of a film, all or nothing. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        throw new UnsupportedOperationException("To come");
    }

    /**
     * Reads a file: as written by this class or as the paper's authors' "Raw Data.csv".
     *
     * @throws FormatException when the file is not one of these
     */
    public static ImportedTracks read(Path source) throws IOException {
        throw new UnsupportedOperationException("To come");
    }
}
