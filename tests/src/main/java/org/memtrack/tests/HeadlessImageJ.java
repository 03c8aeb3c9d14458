// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import java.io.IOException;
import java.nio.file.DirectoryStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/**
 * Tracks one film in headless ImageJ with the plug-in's jar, as a macro does, and says where the results are.
 *
 * <p>Arguments: the film (TIFF, AVI or folder of pictures), the folder for the results, further options of "MEMTrack
 * Track". Ends with 0 when the film was tracked, 1 when the command failed, 2 when the arguments are wrong.
 */
public final class HeadlessImageJ {
    private HeadlessImageJ() {}

    public static void main(String[] arguments) {
        int code;
        try {
            code = run(arguments);
        } catch (IllegalArgumentException e) {
            System.err.println(e.getMessage());
            code = 2;
        } catch (IOException | ReflectiveOperationException | RuntimeException e) {
            e.printStackTrace();
            code = 1;
        }
        // ImageJ leaves threads behind.
        System.exit(code);
    }

    private static int run(String[] arguments) throws IOException, ReflectiveOperationException {
        if (arguments.length < 2 || arguments.length > 3) {
            throw new IllegalArgumentException(
                    "Give a film, a folder for the results and, if wanted, further options.");
        }
        Path film = Path.of(arguments[0]).toAbsolutePath().normalize();
        Path output = Path.of(arguments[1]).toAbsolutePath().normalize();
        String options = "output=[%s] %s".formatted(output, arguments.length == 3 ? arguments[2] : "");
        Map<Path, FileTime> before = results(output);
        String result = new MacroSession().run(FilmMacro.of(film, options), film.toString());
        List<Path> written = results(output).entrySet().stream()
                .filter(file -> !file.getValue().equals(before.get(file.getKey())))
                .map(Map.Entry::getKey)
                .toList();
        if (result.equals("[aborted]") || written.isEmpty()) {
            System.err.println("The film was not tracked; the reason is told above.");
            return 1;
        }
        for (Path file : written) {
            if (file.toString().endsWith(".motility.csv")) {
                System.out.println();
                System.out.print(new TrackTable(file).describe());
            }
        }
        System.out.println();
        written.forEach(file -> System.out.println("  " + file));
        return 0;
    }

    private static Map<Path, FileTime> results(Path output) throws IOException {
        Map<Path, FileTime> found = new TreeMap<>();
        if (Files.isDirectory(output)) {
            try (DirectoryStream<Path> files = Files.newDirectoryStream(output, "*.{xml,csv,mdf,json,png}")) {
                for (Path file : files) {
                    found.put(file, Files.getLastModifiedTime(file));
                }
            }
        }
        return found;
    }
}
