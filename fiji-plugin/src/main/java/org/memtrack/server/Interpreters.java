// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;

/** Where Pythons are looked for. */
final class Interpreters {
    private static final List<String> NAMES =
            List.of("python3", "python", "py", "python3.14", "python3.13", "python3.12", "python3.11");

    private Interpreters() {}

    /**
     * Pythons that may start the server, best first: the one given, or that of MEMTRACK_PYTHON, or the environment made
     * by our installer followed by those on this machine.
     *
     * @throws DetectorException when the one that was named does not exist, or its name is no path
     */
    static List<Interpreter> candidates(@Nullable Path given, Map<String, String> environment, Path dataFolder) {
        if (given != null) {
            return List.of(named(given, "as given"));
        }
        String named = environment.getOrDefault("MEMTRACK_PYTHON", "");
        if (!named.isBlank()) {
            return List.of(named(VariablePath.of("MEMTRACK_PYTHON", named), "named by MEMTRACK_PYTHON"));
        }
        List<Interpreter> found = new ArrayList<>();
        PythonEnvironment.installed(dataFolder).ifPresent(installed -> found.add(installed.interpreter()));
        found.addAll(onThisMachine(environment));
        return found;
    }

    /** Pythons on the path, then those in the usual places. */
    static List<Interpreter> onThisMachine(Map<String, String> environment) {
        return onThisMachine(environment, UsualFolders.ofThisMachine(environment));
    }

    static List<Interpreter> onThisMachine(Map<String, String> environment, List<Path> usualFolders) {
        String path = environment.getOrDefault("PATH", environment.getOrDefault("Path", ""));
        List<Path> pathFolders = Stream.of(path.split(Pattern.quote(File.pathSeparator)))
                .filter(folder -> !folder.isBlank())
                .flatMap(folder -> absolute(folder).stream())
                .toList();
        List<Interpreter> found = new ArrayList<>(in(pathFolders, "on the path"));
        in(usualFolders, "in a usual place").stream()
                .filter(python ->
                        found.stream().noneMatch(other -> other.command().equals(python.command())))
                .forEach(found::add);
        return found;
    }

    /**
     * Pythons in some folders, by name, those of one name in the order of the folders: the first may not work, as a shim of
     * pyenv for a version that is not selected, or the stub of the Windows Store.
     */
    private static List<Interpreter> in(List<Path> folders, String origin) {
        List<Path> places = eachOnce(folders);
        return NAMES.stream()
                .flatMap(name -> find(name, places))
                .map(file -> new Interpreter(
                        file.getFileName().toString().matches("py(\\.exe)?")
                                ? List.of(file.toString(), "-3")
                                : List.of(file.toString()),
                        origin,
                        null))
                .toList();
    }

    private static Interpreter named(Path python, String origin) {
        if (!Files.isRegularFile(python)) {
            throw new DetectorException(
                    "There is no Python at %s, %s: give the path of the interpreter itself, for example %s."
                            .formatted(python, origin, windows() ? "C:\\...\\python.exe" : "/.../bin/python"));
        }
        return new Interpreter(List.of(python.toAbsolutePath().toString()), origin, null);
    }

    private static Stream<Path> find(String name, List<Path> folders) {
        String file = windows() ? name + ".exe" : name;
        return folders.stream()
                .map(folder -> folder.resolve(file))
                .filter(Files::isExecutable)
                .filter(Files::isRegularFile);
    }

    /** Without folders that lead to an earlier one: /bin is often a link to /usr/bin. */
    private static List<Path> eachOnce(List<Path> folders) {
        Set<Path> seen = new HashSet<>();
        return folders.stream().filter(folder -> seen.add(target(folder))).toList();
    }

    private static Path target(Path folder) {
        try {
            return folder.toRealPath();
        } catch (IOException e) {
            return folder;
        }
    }

    private static Optional<Path> absolute(String folder) {
        try {
            return Optional.of(Path.of(folder).toAbsolutePath());
        } catch (InvalidPathException e) {
            return Optional.empty();
        }
    }

    static boolean windows() {
        return System.getProperty("os.name", "").toLowerCase(Locale.ROOT).startsWith("windows");
    }
}
