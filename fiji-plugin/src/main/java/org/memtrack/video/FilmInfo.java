// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import java.nio.file.Path;
import java.util.Optional;
import java.util.OptionalDouble;

/**
 * What is known of a film besides its pixels.
 *
 * @param title name the user sees
 * @param file that holds the film, absolute; empty when none does
 * @param width columns of a frame, pixels
 * @param height rows of a frame, pixels
 * @param frameCount frames of the film
 * @param pixelSizeMicrometres edge of a pixel; empty when the film is not calibrated
 * @param frameIntervalSeconds time between two frames; empty when the film does not say
 */
public record FilmInfo(
        String title,
        Optional<Path> file,
        int width,
        int height,
        int frameCount,
        OptionalDouble pixelSizeMicrometres,
        OptionalDouble frameIntervalSeconds) {
    public FilmInfo {
        if (width < 1 || height < 1 || frameCount < 1) {
            throw new IllegalArgumentException("A film has at least one frame of one pixel, not %d of %d x %d"
                    .formatted(frameCount, width, height));
        }
        file = file.map(Path::toAbsolutePath);
        requirePositive("pixel size", pixelSizeMicrometres);
        requirePositive("frame interval", frameIntervalSeconds);
    }

    /** Whether both pixel size and frame interval are known, so that speeds can be told in um/s. */
    public boolean calibrated() {
        return pixelSizeMicrometres.isPresent() && frameIntervalSeconds.isPresent();
    }

    static void requirePositive(String name, OptionalDouble value) {
        if (value.isPresent() && !(value.getAsDouble() > 0 && Double.isFinite(value.getAsDouble()))) {
            throw new IllegalArgumentException(
                    "The %s must be a positive number, not %s".formatted(name, value.getAsDouble()));
        }
    }
}
