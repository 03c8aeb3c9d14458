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
        return film.processor(frame - 1);
    }

    @Override
    public int getBitDepth() {
        return film.image().getBitDepth();
    }
}
