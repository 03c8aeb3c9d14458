// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import ij.ImagePlus;
import ij.io.FileInfo;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/**
 * The file that holds a film, with what the user should know about it.
 *
 * @param path empty when there is none, or none that is as the image is now
 * @param warnings one sentence each
 */
record FilmFile(Optional<Path> path, List<String> warnings) {

    /** Where the image was opened from or saved to, unless it was cropped or lost frames since. */
    static FilmFile of(ImagePlus image) {
        FileInfo source = image.getOriginalFileInfo();
        Optional<Path> path = path(source).filter(file -> !isOneOfManyPictures(image, file));
        if (path.isPresent() && !hasShapeOf(source, image)) {
            return new FilmFile(
                    Optional.empty(),
                    List.of(
                            "\"%s\" was cropped or has lost frames since it was opened from %s, so the .xml names no film: save it first, and TrackMate finds it."
                                    .formatted(image.getTitle(), path.get())));
        }
        return new FilmFile(path, List.of());
    }

    private static Optional<Path> path(@Nullable FileInfo source) {
        if (source == null || source.fileName == null || source.fileName.isBlank()) {
            return Optional.empty();
        }
        try {
            return Optional.of(Path.of(source.directory == null ? "" : source.directory, source.fileName))
                    .filter(Files::isRegularFile);
        } catch (InvalidPathException e) {
            return Optional.empty();
        }
    }

    /** A folder of pictures names its first one as its file. */
    private static boolean isOneOfManyPictures(ImagePlus image, Path file) {
        String name = file.getFileName().toString().toLowerCase(Locale.ROOT);
        return image.getStackSize() > 1 && name.matches(".*\\.(png|jpe?g|bmp|gif|pgm)");
    }

    /** As far as ImageJ says: nothing of an AVI, and of a TIFF by other programs not always how many frames there are. */
    private static boolean hasShapeOf(FileInfo source, ImagePlus image) {
        boolean size = source.width == 0 || source.width == image.getWidth() && source.height == image.getHeight();
        return size && (source.nImages <= 1 || source.nImages == image.getStackSize());
    }
}
