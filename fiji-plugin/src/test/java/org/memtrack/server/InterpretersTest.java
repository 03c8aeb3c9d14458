// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.abort;

import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.condition.DisabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

class InterpretersTest {
    @TempDir
    Path folder;

    private Path given;
    private Path named;
    private Path onPath;
    private Map<String, String> environment;

    @BeforeEach
    void makePrograms() throws Exception {
        given = program("given", "python");
        named = program("named", "python");
        onPath = program("path", "python3");
        environment = Map.of("PATH", "relative" + File.pathSeparator + onPath.getParent());
    }

    @Test
    void theOneGivenStandsAloneThenTheVariableThenOursThenThePath() throws Exception {
        Map<String, String> withVariable = Map.of("MEMTRACK_PYTHON", named.toString(), "PATH", environment.get("PATH"));
        assertThat(commands(Interpreters.candidates(given, withVariable, folder)))
                .containsExactly(given);
        assertThat(commands(Interpreters.candidates(null, withVariable, folder)))
                .containsExactly(named);
        assertThat(commands(Interpreters.candidates(null, environment, folder))).containsExactly(onPath);

        PythonEnvironment installed = new PythonEnvironment(folder.resolve("env-1"), "0.1.0", null);
        Files.createDirectories(installed.python().getParent());
        executable(installed.python());
        assertThat(commands(Interpreters.candidates(null, environment, folder)))
                .as("an environment that is not finished")
                .containsExactly(onPath);
        installed.use(folder);
        assertThat(commands(Interpreters.candidates(null, environment, folder)))
                .containsExactly(installed.python(), onPath);
    }

    @Test
    void aPathToNothingIsOneSentence() {
        assertThatThrownBy(() -> Interpreters.candidates(folder.resolve("nothing"), environment, folder))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("as given");
        assertThatThrownBy(() -> Interpreters.candidates(null, Map.of("MEMTRACK_PYTHON", folder.toString()), folder))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("MEMTRACK_PYTHON");
    }

    @Test
    void pythonsInTheirUsualPlacesComeAfterThePathNewestFirst() throws Exception {
        Path root = folder.resolve("root");
        String framework = "root/Library/Frameworks/Python.framework/Versions/";
        Path old = program(framework + "3.9/bin", "python3.9");
        Path older = program(framework + "3.9/bin", "python3");
        Path twelve = program(framework + "3.12/bin", "python3.12");
        Path newest = program(framework + "3.12/bin", "python3");
        Path homebrew = program("root/opt/homebrew/bin", "python3.13");
        Map<String, String> finder = Map.of("PATH", onPath.getParent().toString());
        assertThat(commands(Interpreters.onThisMachine(finder, UsualFolders.of("Mac OS X", root, finder))))
                .containsExactly(onPath, newest, older, homebrew, twelve)
                .doesNotContain(old);

        Path windows = program("local/Programs/Python/Python313", "python");
        Path windowsOlder = program("local/Programs/Python/Python39", "python");
        program("local/Programs/Python/Python314-32", "python");
        Map<String, String> startMenu =
                Map.of("LOCALAPPDATA", folder.resolve("local").toString());
        assertThat(commands(Interpreters.onThisMachine(startMenu, UsualFolders.of("Windows 11", root, startMenu))))
                .containsExactly(windows, windowsOlder);
        assertThat(UsualFolders.of("Linux", root, startMenu)).isEmpty();
    }

    @Test
    void aPythonThatIsTooOldByItsNameIsNotTried() throws Exception {
        Path least = program("named", "python3.11");
        program("named", "python3.10");
        Map<String, String> path = Map.of("PATH", least.getParent().toString());
        assertThat(commands(Interpreters.onThisMachine(path, List.of()))).containsExactly(named, least);
    }

    @Test
    void aPythonOnThePathIsNotFoundASecondTime() {
        assertThat(Interpreters.onThisMachine(environment, List.of(onPath.getParent())))
                .hasSize(1);
    }

    @Test
    void aFolderThatIsALinkToOneOnThePathIsNotSearched() throws Exception {
        Path link = folder.resolve("bin");
        try {
            Files.createSymbolicLink(link, onPath.getParent());
        } catch (IOException e) {
            abort("Links need a right on Windows: " + e.getMessage());
        }
        Map<String, String> both = Map.of("PATH", onPath.getParent() + File.pathSeparator + link);
        assertThat(commands(Interpreters.onThisMachine(both, List.of()))).containsExactly(onPath);
    }

    /** As a shim of pyenv for a version that is not selected, or the stub of the Windows Store. */
    @Test
    @DisabledOnOs(value = OS.WINDOWS, disabledReason = "the shim is a shell script")
    void aShimThatEndsInAnErrorDoesNotHideAPythonOfItsName() throws Exception {
        Interpreter real = Interpreters.onThisMachine(System.getenv()).get(0);
        Path python = Path.of(real.command().get(0));
        Path shim = program("shims", python.getFileName().toString());
        Files.writeString(shim, "#!/bin/sh\necho 'pyenv: command not found' >&2\nexit 127\n");
        Map<String, String> pyenv = Map.of("PATH", shim.getParent() + File.pathSeparator + python.getParent());
        List<Interpreter> found = Interpreters.onThisMachine(pyenv, List.of());
        assertThat(commands(found)).startsWith(shim, python);
        List<String> objections = new ArrayList<>();
        assertThat(BasePython.choose(found, objections, Progress.NONE)).contains(real);
        assertThat(objections).containsExactly(shim + " (on the path) is no Python");
    }

    @Test
    void aVariableThatHoldsNoPathIsOneSentence() {
        assertThatThrownBy(() -> Interpreters.candidates(null, Map.of("MEMTRACK_PYTHON", "py\0thon"), folder))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("The variable MEMTRACK_PYTHON is \"py\0thon\", which is no path");
        assertThatThrownBy(() -> DataFolder.path(Map.of("MEMTRACK_HOME", "ho\0me"), "Linux", folder))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("The variable MEMTRACK_HOME is \"ho\0me\", which is no path");
    }

    @Test
    void theDataFolderIsTheUsualOneOfEachSystem() {
        Path home = folder.resolve("home");
        assertThat(DataFolder.path(Map.of("MEMTRACK_HOME", folder.toString()), "Linux", home))
                .isEqualTo(folder);
        assertThat(DataFolder.path(Map.of(), "Linux", home)).endsWithRaw(Path.of(".local", "share", "memtrack"));
        assertThat(DataFolder.path(Map.of(), "Mac OS X", home))
                .endsWithRaw(Path.of("Library", "Application Support", "MEMTrack"));
        assertThat(DataFolder.path(Map.of("LOCALAPPDATA", folder.toString()), "Windows 11", home))
                .isEqualTo(folder.resolve("MEMTrack"));
    }

    private static List<Path> commands(List<Interpreter> interpreters) {
        return interpreters.stream()
                .map(found -> Path.of(found.command().get(0)))
                .toList();
    }

    private Path program(String parent, String name) throws Exception {
        Path made = folder.resolve(parent).resolve(Interpreters.windows() ? name + ".exe" : name);
        Files.createDirectories(made.getParent());
        return executable(made);
    }

    private static Path executable(Path file) throws Exception {
        Files.writeString(file, "");
        assertThat(file.toFile().setExecutable(true)).isTrue();
        return file;
    }
}
