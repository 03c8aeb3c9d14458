// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import ij.VirtualStack;
import ij.process.ImageProcessor;
import org.memtrack.detection.DetectorException;
import org.memtrack.video.ImageFilm;

/** The frames of a film as a stack of its own, read one by one when they are wanted. */
final class FilmStack extends VirtualStack {
    private final ImageFilm film;

    FilmStack(ImageFilm film) {
        super(film.info().width(), film.info().height(), film.info().frameCount());
        this.film = film;
    }

    /** @throws DetectorException when the film's image cannot read it */
    @Override
    public ImageProcessor getProcessor(int frame) {
        int slice = film.sliceOf(frame - 1);
        ImageProcessor processor = film.image().getStack().getProcessor(slice);
        if (processor == null) {
            throw new DetectorException(
                    "Slice %d of \"%s\" cannot be read: open the film again and check that its files are still there."
                            .formatted(slice, film.info().title()));
        }
        return processor;
    }

    @Override
    public int getBitDepth() {
        return film.image().getBitDepth();
    }
}
