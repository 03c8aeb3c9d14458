// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.macro.Interpreter;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.DetectorException;

class MacroOptionsTest {
    private static Map<String, String> read = Map.of();
    private static String refused = "";

    @Test
    void aValueMayStandInAVariableOfTheMacro() {
        run("dir = '/my films/out'; size = 0.25; n = 30;", "output=&dir pixel_size=[&size] min_length=&n preset=water");
        assertThat(read)
                .containsExactly(
                        Map.entry("output", "/my films/out"),
                        Map.entry("pixel_size", "0.25"),
                        Map.entry("min_length", "30"),
                        Map.entry("preset", "water"));
    }

    @Test
    void aVariableThatIsNotThereIsOneSentence() {
        run("dir = '/out';", "output=&folder");
        assertThat(refused)
                .isEqualTo(
                        "The macro has no variable folder for output=&folder: set it before, or give the value itself.");
        assertThatThrownBy(() -> MacroOptions.of("output=&dir")).isInstanceOf(DetectorException.class);
    }

    @Test
    void anAmpersandElsewhereIsPartOfTheValue() {
        assertThat(MacroOptions.of("output=[/black & white/&dir]")).containsEntry("output", "/black & white/&dir");
    }

    private static void run(String variables, String line) {
        String macro = "%s call('%s.run', '%s');".formatted(variables, Command.class.getName(), line);
        new Interpreter().run(macro.replace('\'', '"'));
    }

    /** What the macro calls. */
    public static final class Command {
        private Command() {}

        public static String run(String line) {
            try {
                read = MacroOptions.of(line);
            } catch (DetectorException e) {
                refused = e.getMessage();
            }
            return "";
        }
    }
}
