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
 * @param openedFrom the file, or the folder of pictures, that the image was opened from or saved to, absolute
 * @param path that, where it is one file, and as the image is now
 * @param warnings one sentence each
 */
record FilmFile(Optional<Path> openedFrom, Optional<Path> path, List<String> warnings) {

    /** Where the image was opened from or saved to; no file holds it when it was cropped or lost frames since. */
    static FilmFile of(ImagePlus image) {
        FileInfo source = image.getOriginalFileInfo();
        Optional<Path> openedFrom = openedFrom(source);
        if (openedFrom.isEmpty()) {
            return new FilmFile(openedFrom, openedFrom, List.of());
        }
        Path place = openedFrom.get();
        if (Files.isDirectory(place) || isOneOfManyPictures(image, place)) {
            return noFile(
                    place,
                    "\"%s\" was opened from single pictures, so the .xml names no film: save it as a TIFF first, and TrackMate finds it."
                            .formatted(image.getTitle()));
        }
        if (!hasShapeOf(source, image)) {
            return noFile(
                    place,
                    "\"%s\" was cropped or has lost frames since it was opened from %s, so the .xml names no film: save it first, and TrackMate finds it."
                            .formatted(image.getTitle(), place));
        }
        return new FilmFile(openedFrom, openedFrom, List.of());
    }

    private static FilmFile noFile(Path openedFrom, String warning) {
        return new FilmFile(Optional.of(openedFrom), Optional.empty(), List.of(warning));
    }

    /** ImageJ tells of a folder of pictures by a file without a name. */
    private static Optional<Path> openedFrom(@Nullable FileInfo source) {
        if (source == null || source.fileName == null) {
            return Optional.empty();
        }
        try {
            String folder = source.directory == null ? "" : source.directory;
            return source.fileName.isBlank()
                    ? Optional.of(Path.of(folder).toAbsolutePath())
                            .filter(pictures -> !folder.isBlank() && Files.isDirectory(pictures))
                    : Optional.of(Path.of(folder, source.fileName).toAbsolutePath())
                            .filter(Files::isRegularFile);
        } catch (InvalidPathException e) {
            return Optional.empty();
        }
    }

    /** Some readers name the first of many pictures as the file. */
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
