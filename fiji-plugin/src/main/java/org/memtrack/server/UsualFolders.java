// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;

/**
 * Folders that installers of Python use, newest Python first: a Fiji started from the Finder has a path of the system's own
 * folders only, and on Windows the installer from python.org leaves the path alone.
 */
final class UsualFolders {
    private static final Pattern VERSION = Pattern.compile("(?:Python)?3\\.?(\\d{1,2})");

    private UsualFolders() {}

    static List<Path> ofThisMachine(Map<String, String> environment) {
        return of(System.getProperty("os.name", ""), Path.of("/"), environment);
    }

    /**
     * Those of a system.
     *
     * @param system name of the operating system, as Java has it
     * @param root of its files
     */
    static List<Path> of(String system, Path root, Map<String, String> environment) {
        String name = system.toLowerCase(Locale.ROOT);
        if (name.startsWith("mac")) {
            List<Path> folders = new ArrayList<>();
            newestFirst(root.resolve("Library/Frameworks/Python.framework/Versions"))
                    .forEach(version -> folders.add(version.resolve("bin")));
            folders.add(root.resolve("opt/homebrew/bin"));
            folders.add(root.resolve("usr/local/bin"));
            return folders;
        }
        String local = environment.getOrDefault("LOCALAPPDATA", "");
        if (name.startsWith("windows") && !local.isBlank()) {
            return newestFirst(VariablePath.of("LOCALAPPDATA", local).resolve("Programs/Python"));
        }
        return List.of();
    }

    private static List<Path> newestFirst(Path parent) {
        if (!Files.isDirectory(parent)) {
            return List.of();
        }
        try (Stream<Path> all = Files.list(parent)) {
            return all.filter(folder -> minorVersion(folder) >= 0)
                    .sorted(Comparator.comparingInt(UsualFolders::minorVersion).reversed())
                    .toList();
        } catch (IOException e) {
            System.getLogger("org.memtrack").log(System.Logger.Level.INFO, "Not searched for Python: " + parent, e);
            return List.of();
        }
    }

    /** 13 for "3.13" or "Python313"; -1 for a folder of something else, for example a 32-bit Python. */
    private static int minorVersion(Path folder) {
        Matcher version = VERSION.matcher(folder.getFileName().toString());
        return version.matches() ? Integer.parseInt(version.group(1)) : -1;
    }
}
