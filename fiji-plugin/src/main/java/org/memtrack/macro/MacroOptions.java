// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import ij.macro.Interpreter;
import java.math.BigDecimal;
import java.util.Map;
import org.memtrack.detection.DetectorException;

/** The options that a macro gives to a command. */
public final class MacroOptions {
    private MacroOptions() {}

    /**
     * Keys and values as of {@link OptionLine#parse}. As in ImageJ's own commands, a value {@code &name} stands for what the
     * running macro's variable of that name holds.
     *
     * @throws DetectorException also when there is no such variable
     */
    public static Map<String, String> of(String line) {
        Map<String, String> options = OptionLine.parse(line);
        options.replaceAll((key, value) -> value.startsWith("&") ? variable(key, value.substring(1)) : value);
        return options;
    }

    private static String variable(String key, String name) {
        Interpreter macro = Interpreter.getInstance();
        if (macro != null) {
            String text = macro.getStringVariable(name);
            if (text != null) {
                return text;
            }
            double number = macro.getVariable2(name);
            if (!Double.isNaN(number)) {
                // Not 30.0, which is no whole number to an option.
                return new BigDecimal(Double.toString(number))
                        .stripTrailingZeros()
                        .toPlainString();
            }
        }
        throw new DetectorException("The macro has no variable %s for %s=&%s: set it before, or give the value itself."
                .formatted(name, key, name));
    }
}
