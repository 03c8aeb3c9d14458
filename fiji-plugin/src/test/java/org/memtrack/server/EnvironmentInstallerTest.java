// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeFalse;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Real environments of the Python on the path, with a wheel that needs no network. */
@Timeout(600)
class EnvironmentInstallerTest {
    @TempDir
    Path folder;

    private Path data;

    @BeforeEach
    void chooseAnUncomfortableFolder() {
        data = folder.resolve("my data [1] ü 细菌");
    }

    @Test
    void aNewEnvironmentTakesThePlaceOfTheOlderOneOnlyWhenItWorks() throws Exception {
        PythonEnvironment older = install(SmallWheel.of(SmallWheel.SERVER, ">=3"));
        assertThat(PythonEnvironment.installed(data)).contains(older);
        assertThat(older.version()).isEqualTo("9.9.9");
        assertThat(older.python()).isRegularFile();

        assertThatThrownBy(() -> install(SmallWheel.of(SmallWheel.SERVER, ">=4")))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("installing the packages")
                .hasMessageContaining("requires a different Python")
                .hasMessageContaining("install.log");
        assertThat(environments()).containsExactly(older.folder());
        assertThat(PythonEnvironment.installed(data)).contains(older);
        assertThat(data.resolve("install.log")).content().contains("requires a different Python");

        List<String> said = new ArrayList<>();
        PythonEnvironment newer =
                installer(SmallWheel.of(SmallWheel.SERVER, ">=3")).install(null, false, heard(said));
        assertThat(PythonEnvironment.installed(data)).contains(newer);
        assertThat(environments())
                .as("the server of another ImageJ may run in the older one")
                .containsExactlyInAnyOrder(older.folder(), newer.folder());
        assertThat(said)
                .contains(
                        "Looking for Python", "Making the environment", "Installing", "Trying the server", "Installed");
    }

    @Test
    void ofTheFoldersInTheDataFolderOnlyOldEnvironmentsOfOursAreDeleted() throws Exception {
        Path theirs = Files.createDirectories(data.resolve("env-tensorflow").resolve("memtrack-wheel"));
        Path namedAsOurs = Files.createDirectories(
                data.resolve("env-9.9.9-20200101-000000").resolve("bin"));
        Path ours = data.resolve("env-0.0.9-20200101-000000");
        SmallWheel.of(SmallWheel.SERVER, ">=3").writeTo(ours.resolve("memtrack-wheel"));
        PythonEnvironment made = install(SmallWheel.of(SmallWheel.SERVER, ">=3"));
        assertThat(environments())
                .containsExactlyInAnyOrder(theirs.getParent(), namedAsOurs.getParent(), made.folder());
        assertThat(theirs).isDirectory();
        assertThat(namedAsOurs).isDirectory();
    }

    @Test
    void anEnvironmentTellsWhenItIsOfAnotherBuildThanThePlugin() throws Exception {
        ServerWheel wheel = SmallWheel.of(SmallWheel.SERVER, ">=3");
        PythonEnvironment made = install(wheel);
        assertThat(PythonEnvironment.installed(data).orElseThrow().warning(wheel))
                .isEmpty();

        ServerWheel ofTheSameVersion = SmallWheel.of(SmallWheel.SERVER + "# changed", ">=3");
        assertThat(made.warning(ofTheSameVersion).orElseThrow())
                .contains(made.folder() + " is of another build than this plug-in")
                .endsWith("run Plugins > Tracking > MEMTrack > MEMTrack Install Python Environment again.");

        // As plug-ins wrote it that kept no fingerprint.
        Files.writeString(
                data.resolve("environment.json"),
                "{\"folder\":\"%s\",\"version\":\"9.9.9\"}"
                        .formatted(made.folder().getFileName()));
        assertThat(PythonEnvironment.installed(data).orElseThrow().warning(wheel))
                .isEqualTo(made.warning(ofTheSameVersion));
    }

    @Test
    void forTrainingTheExtraThatTheServerHasForItIsInstalled() throws Exception {
        ServerWheel wheel = SmallWheel.of(SmallWheel.SERVER, ">=3");
        installer(wheel).install(null, true, Progress.NONE);
        assertThat(data.resolve("install.log")).content().contains("memtrack").doesNotContain("does not provide");
        assertThat(Path.of("..", "model-server", "pyproject.toml")).content().containsPattern("(?m)^train = .*nncf");
    }

    @Test
    void cancellingLeavesNothingBehind() throws Exception {
        Progress cancelledWhenMade = new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

            @Override
            public boolean cancelled() {
                return Files.isDirectory(data) && !environments().isEmpty();
            }
        };
        ServerWheel wheel = SmallWheel.of(SmallWheel.SERVER, ">=3");
        assertThatThrownBy(() -> installer(wheel).install(null, false, cancelledWhenMade))
                .isInstanceOf(CancellationException.class);
        assertThat(environments()).isEmpty();
        assertThat(PythonEnvironment.installed(data)).isEmpty();
    }

    @Test
    void anInstallationThatIsCancelledWhileItPrintsEndsAsCancelledAndLeavesItsLog() throws Exception {
        assumeFalse(Interpreters.windows(), "A script of the shell stands for the interpreter.");
        EnvironmentStart talkative = (environment, progress) -> {
            Path python = Files.createDirectories(environment.resolve("bin")).resolve("python");
            Files.writeString(python, "#!/bin/sh\nwhile :; do echo more; done\n");
            assertThat(python.toFile().setExecutable(true)).isTrue();
        };
        AtomicReference<String> said = new AtomicReference<>("");
        Progress cancelledWhenItPrints = new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
                said.set(message);
            }

            @Override
            public boolean cancelled() {
                return said.get().equals("more");
            }
        };
        Files.createDirectories(data);
        EnvironmentInstaller installer = installer(SmallWheel.of(SmallWheel.SERVER, ">=3"));
        assertThatThrownBy(() -> installer.make(talkative, false, cancelledWhenItPrints))
                .isInstanceOf(CancellationException.class);
        assertThat(Files.readAllLines(installer.log())).hasSizeGreaterThan(1).containsOnly("more");
    }

    @Test
    void whatCannotBeDeletedDoesNotHideWhyTheInstallationEnded() throws Exception {
        assumeTrue(System.getProperty("os.name").equals("Linux"), "Others limit the length of a path otherwise.");
        Path apart = folders(folder.resolve("apart"), 18);
        AtomicReference<Path> tooDeep = new AtomicReference<>();
        EnvironmentStart cancelled = (environment, progress) -> {
            tooDeep.set(folders(environment, 18).resolve("deeper"));
            Files.move(folder.resolve("apart"), tooDeep.get());
            throw new CancellationException("Cancelled by the user.");
        };
        Files.createDirectories(data);
        EnvironmentInstaller installer = installer(SmallWheel.of(SmallWheel.SERVER, ">=3"));
        try {
            assertThatThrownBy(() -> installer.make(cancelled, false, Progress.NONE))
                    .isInstanceOf(CancellationException.class);
            assertThat(environments()).as("what is too deep to delete").hasSize(1);
        } finally {
            Files.move(tooDeep.get(), folder.resolve("apart"));
        }
        assertThat(apart).isDirectory();
    }

    /** The innermost of folders in each other; one branch of 18 in another makes a path longer than 4096 characters. */
    private static Path folders(Path outermost, int count) throws IOException {
        Path innermost = outermost;
        for (int i = 0; i < count; i++) {
            innermost = innermost.resolve("x".repeat(120));
        }
        return Files.createDirectories(innermost);
    }

    @Test
    void twoInstallationsDoNotMeet() throws Exception {
        Files.createDirectories(data);
        Path lock = data.resolve("install.lock");
        try (FileChannel channel = FileChannel.open(lock, StandardOpenOption.CREATE, StandardOpenOption.WRITE)) {
            channel.lock();
            assertThatThrownBy(() -> install(SmallWheel.of(SmallWheel.SERVER, ">=3")))
                    .isInstanceOf(DetectorException.class)
                    .hasMessageContaining("wait for it");
        }
    }

    @Test
    void whatIsNoPythonIsToldSo() throws Exception {
        Path java = Path.of(ProcessHandle.current().info().command().orElseThrow());
        assertThatThrownBy(() -> installer(SmallWheel.of("", ">=3")).install(java, false, Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(java.toString())
                .hasMessageContaining("is no Python");
    }

    @Test
    void knownCausesAreToldInPlainWords() {
        assertThat(InstallFailures.cause(List.of(
                        "WARNING: Retrying after connection broken by 'NewConnectionError(...)'",
                        "ERROR: No matching distribution found for numpy>=1.26")))
                .isEqualTo("the package index cannot be reached; check the network");
        assertThat(InstallFailures.cause(List.of("ERROR: [Errno 28] No space left on device")))
                .isEqualTo("the disk is full");
        assertThat(InstallFailures.cause(
                        List.of("ERROR: Could not install packages due to an OSError: [WinError 32] Der Prozess"
                                + " kann nicht auf die Datei zugreifen")))
                .contains("virus scanner");
        assertThat(InstallFailures.cause(List.of(
                        "python: /lib/libm.so.6: version `GLIBC_2.35' not found (required by libpython3.13.so.1.0)")))
                .contains("needs a newer Linux");
        assertThat(InstallFailures.cause(List.of("Collecting x", "ERROR: something new", "[notice] a new pip")))
                .isEqualTo("something new");
        assertThat(InstallFailures.cause(List.of())).isEqualTo("it did not say why");
    }

    private PythonEnvironment install(ServerWheel wheel) {
        return installer(wheel).install(null, false, Progress.NONE);
    }

    private EnvironmentInstaller installer(ServerWheel wheel) {
        return new EnvironmentInstaller(data, wheel, System.getenv(), Optional.empty());
    }

    private List<Path> environments() {
        try (Stream<Path> all = Files.list(data)) {
            return all.filter(path -> path.getFileName().toString().startsWith("env-"))
                    .toList();
        } catch (IOException e) {
            throw new IllegalStateException(e);
        }
    }

    private static Progress heard(List<String> said) {
        return new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
                said.add(stage);
            }

            @Override
            public boolean cancelled() {
                return false;
            }
        };
    }
}
