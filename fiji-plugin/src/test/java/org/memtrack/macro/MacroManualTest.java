// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;

/** The README's table of options is that of the program; when it is not, the right one lies in target/macro-options.md. */
class MacroManualTest {
    @Test
    void theManualHasEveryOptionAsItIs() throws Exception {
        String table = table();
        Files.writeString(Path.of("target", "macro-options.md"), table);
        assertThat(Files.readString(Path.of("..", "README.md"), StandardCharsets.UTF_8)
                        .replace("\r\n", "\n"))
                .contains(table);
    }

    private static String table() {
        StringBuilder table = new StringBuilder("| key | default | meaning |\n|---|---|---|\n");
        for (TrackOption option : TrackOption.values()) {
            table.append("| `%s` | %s | %s%s |\n"
                    .formatted(
                            option.key(),
                            option.defaultValue().isEmpty() ? "" : "`" + option.defaultValue() + "`",
                            option.help(),
                            option.choices().isEmpty() ? "" : " (`" + String.join("` or `", option.choices()) + "`)"));
        }
        return table.toString();
    }
}
