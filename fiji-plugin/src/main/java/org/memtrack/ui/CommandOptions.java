// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.MacroOptions;

/** The options that a macro gives to a command with few of them. */
final class CommandOptions {
    private CommandOptions() {}

    /**
     * Keys and values of an option line; null is a line without options.
     *
     * @param keys that the command knows
     * @throws DetectorException when the line holds another key
     */
    static Map<String, String> of(@Nullable String line, String command, String... keys) {
        Map<String, String> options = MacroOptions.of(line == null ? "" : line);
        List<String> known = List.of(keys);
        for (String key : options.keySet()) {
            if (!known.contains(key)) {
                throw new DetectorException("\"%s\" is no option of %s: give only %s."
                        .formatted(key, command, String.join(" and ", known)));
            }
        }
        return options;
    }
}
