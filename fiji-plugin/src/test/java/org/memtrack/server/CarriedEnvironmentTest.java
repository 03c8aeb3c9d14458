// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Environments on a machine without Python: a real one from its jar, with a wheel that needs no network. */
@Timeout(600)
class CarriedEnvironmentTest {
    private static final Map<String, String> NO_PYTHON = Map.of("PATH", "");

    @TempDir
    Path folder;

    private Path data;

    @BeforeEach
    void chooseAnUncomfortableFolder() {
        data = folder.resolve("Jörg Müller [1] 细菌");
    }

    @Test
    void aPythonFromAJarServesAndLeavesNoHalfUnpackedOneBehind() throws Exception {
        Optional<CarriedPython> carried = CarriedPython.find();
        assumeTrue(carried.isPresent(), "The jar with a Python that the tests fetch is for Linux on x86_64.");
        // As when ImageJ was killed while it unpacked.
        Path half = data.resolve("env-9.9.9-20200101-000000");
        SmallWheel.of(SmallWheel.SERVER, ">=3").writeTo(half.resolve("memtrack-wheel"));
        Files.writeString(Files.createDirectories(half.resolve("bin")).resolve("python3"), "half");
        assertThat(PythonEnvironment.installed(data)).isEmpty();

        PythonEnvironment made = install(NO_PYTHON, carried);
        assertThat(environments()).containsExactly(made.folder());
        assertThat(PythonEnvironment.installed(data)).contains(made);
        assertThat(run(made, "import sys, ssl, ctypes; print(sys.prefix)"))
                .as("it needs nothing outside its folder")
                .containsExactly(made.folder().toString());

        PythonEnvironment renewed = install(NO_PYTHON, carried);
        assertThat(run(renewed, "print(1)")).containsExactly("1");
        assertThat(environments()).containsExactlyInAnyOrder(made.folder(), renewed.folder());
    }

    @Test
    void aPythonOfTheMachineGoesFirst() throws Exception {
        Optional<CarriedPython> carried = CarriedPython.find();
        assumeTrue(carried.isPresent(), "The jar with a Python that the tests fetch is for Linux on x86_64.");
        assertThat(install(System.getenv(), carried).folder().resolve("pyvenv.cfg"))
                .as("a venv")
                .isRegularFile();
    }

    @Test
    void withoutAnyPythonTheSentenceTellsWhatToDo() {
        assertThatThrownBy(() -> install(NO_PYTHON, Optional.empty()))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("No Python 3.11 or newer was found")
                .hasMessageContaining("install Python 3.11 or newer (on Windows and macOS from python.org")
                .hasMessageContaining(CarriedPython.advice())
                .hasMessageNotContaining("\n");
    }

    private PythonEnvironment install(Map<String, String> environment, Optional<CarriedPython> carried)
            throws IOException {
        ServerWheel wheel = SmallWheel.of(SmallWheel.SERVER, ">=3");
        return new EnvironmentInstaller(data, wheel, environment, carried).install(null, false, Progress.NONE);
    }

    private static List<String> run(PythonEnvironment made, String code) throws IOException, InterruptedException {
        ProcessBuilder builder = made.interpreter().process("-c", code).redirectErrorStream(true);
        builder.environment().keySet().retainAll(List.of("SystemRoot"));
        Process process = builder.start();
        List<String> lines = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8)
                .lines()
                .toList();
        process.waitFor();
        return lines;
    }

    private List<Path> environments() throws IOException {
        try (Stream<Path> all = Files.list(data)) {
            return all.filter(path -> path.getFileName().toString().startsWith("env-"))
                    .toList();
        }
    }
}
