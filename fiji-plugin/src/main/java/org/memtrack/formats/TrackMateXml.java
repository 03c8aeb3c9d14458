// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;

/** TrackMate XML, which TrackMate 7 and 8 open with its film. Spots carry our own {@link SpotFeature}s. */
public final class TrackMateXml {
    private TrackMateXml() {}

    /** Writes the tracks of a film, all or nothing; a track of one point becomes a spot of no track. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        AtomicFiles.write(target, out -> new TrackMateXmlWriter(tracked).write(out));
    }
}
