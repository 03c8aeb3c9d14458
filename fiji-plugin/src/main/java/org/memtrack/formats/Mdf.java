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
}
