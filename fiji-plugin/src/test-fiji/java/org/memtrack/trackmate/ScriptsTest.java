// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.io.TmXmlReader;
import groovy.lang.Binding;
import groovy.lang.GroovyShell;
import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.testing.ExaminationData;
import org.python.util.PythonInterpreter;

/** The scripts that users start from run as they are. */
@Timeout(240)
class ScriptsTest {
    private static final Path SCRIPTS = Path.of("scripts");

    /** As SciJava runs a script: the lines of its parameters taken out, their names bound. */
    private static String withoutParameters(String name, List<String> parameters) throws IOException {
        String script = Files.readString(SCRIPTS.resolve(name));
        assertThat(script.lines().filter(line -> line.startsWith("#@")).map(line -> line.replaceFirst(".* ", "")))
                .containsExactlyInAnyOrderElementsOf(parameters);
        return script.lines().filter(line -> !line.startsWith("#@")).collect(Collectors.joining("\n"));
    }

    private static Map<String, Object> parameters(Path output) {
        File film = ExaminationData.path("bacteria_water", "bacteria_water_TL.tif").toFile();
        return Map.of("film", film, "output", output.toFile(), "pixelSize", 0.4545, "frameInterval", 1 / 26.87);
    }

    private static void check(Path output) {
        TmXmlReader reader = new TmXmlReader(output.toFile());
        assertThat(reader.getModel().getTrackModel().nTracks(true)).isBetween(5, 60);
        assertThat(reader.getModel().getSpaceUnits()).isEqualTo("\u00b5m");
        Settings settings = reader.readSettings(reader.readImage());
        assertThat(reader.isReadingOk()).as(reader.getErrorMessage()).isTrue();
        assertThat(settings.detectorFactory).isInstanceOf(MemtrackDetectorFactory.class);
        assertThat(settings.detectorSettings).containsEntry("THRESHOLDS", "MAXIMUM_F1");
        assertThat(settings.trackerSettings).containsEntry("MINIMUM_TRACK_LENGTH", 30);
    }

    @Test
    void theGroovyScriptTracksAFilm(@TempDir Path folder) throws IOException {
        Path output = folder.resolve("groovy.xml");
        Map<String, Object> parameters = parameters(output);
        String script = withoutParameters("memtrack_in_trackmate.groovy", List.copyOf(parameters.keySet()));
        Binding binding = new Binding();
        parameters.forEach(binding::setVariable);
        new GroovyShell(binding).evaluate(script);
        check(output);
    }

    @Test
    void theJythonScriptTracksAFilm(@TempDir Path folder) throws IOException {
        Path output = folder.resolve("jython.xml");
        Map<String, Object> parameters = parameters(output);
        String script = withoutParameters("memtrack_in_trackmate.py", List.copyOf(parameters.keySet()));
        try (PythonInterpreter interpreter = new PythonInterpreter()) {
            parameters.forEach(interpreter::set);
            interpreter.exec(script);
        }
        check(output);
    }
}
