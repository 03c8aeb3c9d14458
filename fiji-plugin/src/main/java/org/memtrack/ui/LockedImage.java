// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.ImagePlus;
import java.util.concurrent.atomic.AtomicBoolean;
import org.memtrack.detection.DetectorException;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.ImageFilm;

/**
 * An image that is locked until the last frame of its film has been read: another command, or the user who closes the
 * window, would change frames or take them away before they are sent. After that the user may go on with it.
 */
final class LockedImage implements AutoCloseable {
    private final ImagePlus image;
    private final AtomicBoolean held = new AtomicBoolean(true);

    /**
     * Locks an image.
     *
     * @throws DetectorException when another command has locked it
     */
    LockedImage(ImagePlus image) {
        this.image = image;
        if (!image.lockSilently()) {
            throw new DetectorException(
                    "Another command works on \"%s\" and has locked it: wait until it has ended; if it hangs, unlock the image with Plugins > Utilities > Reset."
                            .formatted(image.getTitle()));
        }
    }

    /**
     * Its film, whose last frame gives the lock back.
     *
     * @throws DetectorException see {@link ImageFilm}
     */
    ImageFilm film(FilmOptions options) {
        return new ImageFilm(image, options) {
            @Override
            public byte[] frame(int frame) {
                byte[] samples = super.frame(frame);
                if (frame == info().frameCount() - 1) {
                    close();
                }
                return samples;
            }
        };
    }

    /** Gives the lock back, once: it may be another command's by then. */
    @Override
    public void close() {
        if (held.getAndSet(false)) {
            image.unlock();
        }
    }
}
