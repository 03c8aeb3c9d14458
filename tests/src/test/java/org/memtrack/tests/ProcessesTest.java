// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.io.File;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.TimeUnit;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.DisabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.io.TempDir;

/** The launcher in a process of its own, as the README's command starts it. */
@Timeout(600)
class ProcessesTest {
    @TempDir
    static Path folder;

    private static Path film;

    private final List<Process> launched = new ArrayList<>();

    @BeforeAll
    static void makeAFilm() throws Exception {
        film = folder.resolve("film.tif");
        SwimmersFilm.save(film, 150, 320, 240);
    }

    /** What a failure has left running would slow down all that follows. */
    @AfterEach
    void endWhatStillRuns() {
        for (Process process : launched) {
            process.descendants().forEach(ProcessHandle::destroyForcibly);
            process.destroyForcibly();
        }
    }

    @Test
    void withoutAnyPythonTheProcessFailsWithOneSentence() throws Exception {
        Path log = folder.resolve("no-python.log");
        Process process = launch(
                log,
                Map.of(
                        "PATH",
                        folder.toString(),
                        "MEMTRACK_PYTHON",
                        "",
                        "MEMTRACK_HOME",
                        folder.resolve("home").toString()),
                HeadlessImageJ.class,
                film.toString(),
                folder.resolve("out").toString());
        assertThat(process.waitFor(60, TimeUnit.SECONDS)).isTrue();
        assertThat(process.exitValue()).isEqualTo(1);
        assertThat(log).content(StandardCharsets.UTF_8).contains("No Python was found: install Python 3.11 or newer");
    }

    @Test
    void aWrongFilmEndsWithTwo() throws Exception {
        Path log = folder.resolve("no-film.log");
        Process process = launch(
                log, Map.of(), HeadlessImageJ.class, folder.resolve("none.tif").toString(), folder.toString());
        assertThat(process.waitFor(60, TimeUnit.SECONDS)).isTrue();
        assertThat(process.exitValue()).isEqualTo(2);
        assertThat(log).content(StandardCharsets.UTF_8).contains("none.tif").doesNotContain("\tat ");
    }

    @Test
    void theServerEndsWhenImageJIsKilled() throws Exception {
        Path log = folder.resolve("killed.log");
        Process imageJ = launch(
                log,
                Map.of(),
                HeadlessImageJ.class,
                film.toString(),
                folder.resolve("orphan").toString());
        while (!Files.readString(log).contains("Stabilising")) {
            assertThat(imageJ.isAlive()).as(Files.readString(log)).isTrue();
            Thread.sleep(100);
        }
        List<ProcessHandle> servers = imageJ.descendants().toList();
        assertThat(servers).isNotEmpty();
        imageJ.destroyForcibly();
        for (ProcessHandle server : servers) {
            server.onExit().get(10, TimeUnit.SECONDS);
        }
    }

    @Test
    void aBatchWhoseCommandFailsEndsWithOne() throws Exception {
        assertThat(batch("failing.ijm", "open(\"%s\"); run(\"MEMTrack Track\", \"presett=water\");".formatted(film)))
                .startsWith("1: MEMTrack: \"presett\" is no option of MEMTrack Track");
        assertThat(batch(
                        "filmless.ijm",
                        "open(\"none.tif\"); run(\"MEMTrack Track\", \"output=[%s]\");".formatted(folder)))
                .startsWith("1: ")
                .contains("No film is open");
    }

    @Test
    void aBatchThatSeesToItsFailuresItselfGoesOn() throws Exception {
        Path inner = Files.writeString(folder.resolve("inner.ijm"), "run(\"MEMTrack Track\", \"presett=water\");");
        assertThat(batch("outer.ijm", "print(\"The film gave \" + runMacro(\"%s\"));".formatted(inner)))
                .startsWith("0: ")
                .contains("The film gave [aborted]");
    }

    /** Runs the macro as the command line "-batch" does; gives the exit code and all that was printed. */
    private String batch(String name, String macro) throws Exception {
        Path log = folder.resolve(name + ".log");
        Path file = Files.writeString(folder.resolve(name), macro);
        Process process = launch(log, Map.of(), BatchImageJ.class, "-batch", file.toString());
        assertThat(process.waitFor(100, TimeUnit.SECONDS)).isTrue();
        return process.exitValue() + ": " + Files.readString(log);
    }

    @Test
    void thePluginInstallsItsEnvironmentAndUsesIt() throws Exception {
        Path home = folder.resolve("my home [1] ü 细菌");
        Path log = folder.resolve("install.log");
        Map<String, String> environment =
                Map.of("MEMTRACK_HOME", home.toString(), "MEMTRACK_PYTHON", "", "PYTHONPATH", "");
        Process process = launch(
                log,
                environment,
                Macros.class,
                "run(\"MEMTrack Install Python Environment\", \"python=[%s]\");".formatted(Python.path()),
                "run(\"MEMTrack Check Installation\");");
        assertThat(process.waitFor(550, TimeUnit.SECONDS)).isTrue();
        assertThat(log)
                .content(StandardCharsets.UTF_8)
                .contains("is installed in " + home)
                .contains("(installed by MEMTrack)")
                .contains("Devices: openvino CPU")
                .contains("Model: default")
                .doesNotContain("another build")
                .doesNotContain("[aborted]");
        assertThat(process.exitValue()).isZero();
    }

    /** As after a new jar was put in the place of one that had installed its server. */
    @Test
    @DisabledOnOs(value = OS.WINDOWS, disabledReason = "the environment's Python is a shell script")
    void anInstalledServerOfAnotherBuildIsToldOf() throws Exception {
        Path home = folder.resolve("older build");
        Path python = home.resolve("env-0.1.0-20200101-000000").resolve("bin").resolve("python");
        Files.createDirectories(python.getParent());
        Files.writeString(python, "#!/bin/sh\nexec '%s' \"$@\"\n".formatted(Python.path()));
        assertThat(python.toFile().setExecutable(true)).isTrue();
        Files.writeString(
                home.resolve("environment.json"),
                "{\"folder\": \"env-0.1.0-20200101-000000\", \"version\": \"0.1.0\"}");
        Path log = folder.resolve("older-build.log");
        Process process = launch(
                log,
                Map.of("MEMTRACK_HOME", home.toString(), "MEMTRACK_PYTHON", ""),
                Macros.class,
                "run(\"MEMTrack Check Installation\");",
                "open(\"%s\"); run(\"MEMTrack Track\", \"output=[%s] last_frame=10\");"
                        .formatted(film, folder.resolve("of an older build")));
        assertThat(process.waitFor(100, TimeUnit.SECONDS)).isTrue();
        assertThat(process.exitValue()).as(Files.readString(log)).isZero();
        String sentence = "The server installed in %s is of another build than this plug-in and may not know all of its"
                        .formatted(python.getParent().getParent())
                + " options: run Plugins > Tracking > MEMTrack > MEMTrack Install Python Environment again.";
        String said = Files.readString(log);
        assertThat(said).contains("MEMTrack, note: " + sentence);
        assertThat(said.replace('\n', ' '))
                .as("in lines of the window of the check")
                .containsPattern("SHA-256 .* \\Q%s\\E".formatted(sentence));
    }

    @Test
    void aMachineWithoutPythonGetsThroughWithTheJarThatCarriesOne() throws Exception {
        Optional<Path> jar = carriedPython();
        assumeTrue(jar.isPresent(), "The jar with a Python that the tests fetch is for Linux on x86_64.");
        Path user = folder.resolve("Jörg Müller");
        Path nothing = Files.createDirectories(user.resolve("no programs"));
        Path theirs = Files.copy(film, user.resolve("Fänge.tif"));
        Path output = user.resolve("Bahnen [1]");
        Path log = folder.resolve("carried.log");
        Map<String, String> environment = Map.of(
                "PATH", nothing.toString(),
                "XDG_DATA_HOME", user.resolve(".local").resolve("share").toString(),
                "MEMTRACK_HOME", "",
                "MEMTRACK_PYTHON", "",
                "PYTHONPATH", "",
                "PYTHONHOME", "",
                "LD_LIBRARY_PATH", "");
        Process process = launch(
                log,
                environment,
                List.of(jar.get()),
                Macros.class,
                "run(\"MEMTrack Install Python Environment\");",
                "run(\"MEMTrack Check Installation\");",
                "open(\"%s\"); run(\"MEMTrack Track\", \"output=[%s]\");".formatted(theirs, output));
        assertThat(process.waitFor(550, TimeUnit.SECONDS)).isTrue();
        assertThat(log)
                .content(StandardCharsets.UTF_8)
                .contains("is installed in " + user)
                .contains("Python carried by a jar: " + jar.get())
                .contains("Devices: openvino CPU");
        assertThat(process.exitValue()).as(Files.readString(log)).isZero();
        assertThat(new TrackTable(output.resolve("Fänge.motility.csv")).rows()).hasSize(SwimmersFilm.SWIMMERS);
    }

    /** The jar that the build fetched; empty when it is for another machine. */
    private static Optional<Path> carriedPython() throws IOException {
        if (!System.getProperty("os.name").equals("Linux")
                || !System.getProperty("os.arch").equals("amd64")) {
            return Optional.empty();
        }
        try (Stream<Path> files = Files.list(Path.of("target", "python"))) {
            return Optional.of(files.findFirst().orElseThrow().toAbsolutePath());
        }
    }

    private Process launch(Path log, Map<String, String> environment, Class<?> program, String... arguments)
            throws Exception {
        return launch(log, environment, List.of(), program, arguments);
    }

    /** @param jars further ones, as in Fiji's folder jars */
    private Process launch(
            Path log, Map<String, String> environment, List<Path> jars, Class<?> program, String... arguments)
            throws Exception {
        List<String> command = new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                "--add-opens=java.base/java.lang=ALL-UNNAMED",
                "-Djava.awt.headless=true",
                "-Dfile.encoding=UTF-8",
                "-D%s=%s"
                        .formatted(
                                MacroSession.JARS,
                                jars.stream().map(Path::toString).collect(Collectors.joining(File.pathSeparator))),
                "-cp",
                System.getProperty("java.class.path"),
                program.getName()));
        command.addAll(List.of(arguments));
        ProcessBuilder builder =
                new ProcessBuilder(command).redirectErrorStream(true).redirectOutput(new File(log.toString()));
        environment.forEach((key, value) -> {
            if (value.isEmpty()) {
                builder.environment().remove(key);
            } else {
                builder.environment().put(key, value);
            }
        });
        Process process = builder.start();
        launched.add(process);
        return process;
    }
}
