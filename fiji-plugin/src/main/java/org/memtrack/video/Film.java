// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import java.nio.file.Path;
import java.util.Optional;

/** The frames of a film, read one by one; used by one thread at a time. */
public interface Film {
    /** What is known of the film; its frames are those that {@link #frame} gives. */
    FilmInfo info();

    /** Type of the samples that {@link #frame} gives. */
    SampleType sampleType();

    /**
     * Samples of a frame, row by row, little-endian: {@code width * height * sampleType().bytes()} bytes.
     *
     * @param frame from 0 to {@code info().frameCount() - 1}
     */
    byte[] frame(int frame);

    /**
     * The file or folder it was opened from, absolute, also where it is not as the film is now; empty when it came from none.
     */
    default Optional<Path> openedFrom() {
        return info().file();
    }

    /** Number, from 0, that frame 0 of this film has in the image it was taken from. */
    default int firstFrame() {
        return 0;
    }
}
