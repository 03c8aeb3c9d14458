// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;

/**
 * MTrackJ data files (.mdf).
 *
 * <p>The format has no place for a mark on a point, so an interpolated one is written with a time a quarter of a frame too
 * late: MTrackJ rounds the time of a point to its frame.
 */
public final class Mdf {
    private Mdf() {}

    /** Writes the tracks of a film, all or nothing; a cluster and a colour for each class of motility. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        AtomicFiles.write(target, out -> MdfWriter.write(tracked, out));
    }

    /**
     * Reads a file of MTrackJ 1.0 to 1.5.1; tracks are numbered from 0 in the order of the file.
     *
     * @throws FormatException when the file is not one of these, or is damaged
     */
    public static ImportedTracks read(Path source) throws IOException {
        return MdfReader.read(source);
    }
}
