// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Locale;
import java.util.stream.Stream;

/** The macro that opens a film and tracks it. */
final class FilmMacro {
    private FilmMacro() {}

    /**
     * Macro code; its argument is the film's path, which is thus never quoted.
     *
     * @param options of "MEMTrack Track"
     * @throws IllegalArgumentException when the film is not there or of no kind that ImageJ opens
     */
    static String of(Path film, String options) throws IOException {
        String open = Files.isDirectory(film) ? folder(film) : file(film);
        return open
                + "options = \"%s\";\n".formatted(options.replace("\\", "\\\\").replace("\"", "\\\""))
                // AVI files and folders of pictures come with their frames in Z.
                + "getDimensions(width, height, channels, slices, frames);\n"
                + "if (slices > 1 && frames == 1 && indexOf(options, \"frames=\") < 0) options = \"frames=z \" + options;\n"
                + "run(\"MEMTrack Track\", options);\n";
    }

    private static String folder(Path folder) throws IOException {
        try (Stream<Path> files = Files.list(folder)) {
            if (files.noneMatch(
                    file -> file.toString().toLowerCase(Locale.ROOT).matches(".*\\.(png|tiff?|jpe?g|bmp)"))) {
                throw new IllegalArgumentException(
                        "The folder %s holds no pictures: give one with PNG or TIFF files.".formatted(folder));
            }
        }
        return "File.openSequence(getArgument(), \"virtual\");\n";
    }

    private static String file(Path film) {
        if (!Files.isRegularFile(film)) {
            throw new IllegalArgumentException("There is no film %s: check the path.".formatted(film));
        }
        String name = film.toString().toLowerCase(Locale.ROOT);
        if (name.matches(".*\\.(tiff?|zip|avi)")) {
            // Many cameras write grey films as colour ones.
            return "open(getArgument());\nif (bitDepth() == 24) run(\"8-bit\");\n";
        }
        throw new IllegalArgumentException(
                "%s is no TIFF, AVI or folder of pictures: save it as one of these.".formatted(film));
    }
}
