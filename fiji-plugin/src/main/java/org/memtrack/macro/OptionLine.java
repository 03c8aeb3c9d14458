// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import java.util.LinkedHashMap;
import java.util.Map;
import org.memtrack.detection.DetectorException;

/** The option string of ImageJ's macro language: {@code key=value key=[value with spaces] key}. */
public final class OptionLine {
    private OptionLine() {}

    /**
     * Keys and values in order; a key without a value has the value "true".
     *
     * @throws DetectorException when a key comes twice, a bracket is not closed, or something is no key
     */
    public static Map<String, String> parse(String line) {
        Map<String, String> options = new LinkedHashMap<>();
        int at = 0;
        while (true) {
            while (at < line.length() && Character.isWhitespace(line.charAt(at))) {
                at++;
            }
            if (at == line.length()) {
                return options;
            }
            int keyEnd = at;
            while (keyEnd < line.length()
                    && line.charAt(keyEnd) != '='
                    && !Character.isWhitespace(line.charAt(keyEnd))) {
                keyEnd++;
            }
            String key = line.substring(at, keyEnd);
            if (!key.matches("[A-Za-z_][A-Za-z0-9_]*")) {
                throw new DetectorException(
                        "\"%s\" is no option: put values that hold spaces in brackets, as in output=[/my films/out]."
                                .formatted(key.isEmpty() ? line.substring(at) : key));
            }
            String value = "true";
            at = keyEnd;
            if (keyEnd < line.length() && line.charAt(keyEnd) == '=') {
                at = valueEnd(line, keyEnd + 1, key);
                value = unquoted(line.substring(keyEnd + 1, at));
            }
            if (options.put(key, value) != null) {
                throw new DetectorException("The option \"%s\" is given twice: leave one out.".formatted(key));
            }
        }
    }

    /** The line that {@link #parse} reads as these options; values without a value are left out. */
    public static String format(Map<String, String> options) {
        StringBuilder line = new StringBuilder();
        options.forEach((key, value) -> {
            if (!value.isEmpty()) {
                line.append(line.isEmpty() ? "" : " ").append(key).append('=').append(quoted(value));
            }
        });
        return line.toString();
    }

    private static int valueEnd(String line, int start, String key) {
        if (start < line.length() && line.charAt(start) == '[') {
            return bracketEnd(line, start, key);
        }
        int end = start;
        while (end < line.length() && !Character.isWhitespace(line.charAt(end))) {
            end++;
        }
        return end;
    }

    /** As in ImageJ, brackets inside a value pair up. */
    private static int bracketEnd(String line, int start, String key) {
        int open = 0;
        for (int i = start; i < line.length(); i++) {
            if (line.charAt(i) == '[') {
                open++;
            } else if (line.charAt(i) == ']' && --open == 0) {
                return i + 1;
            }
        }
        throw new DetectorException(
                "The brackets in the value of \"%s\" do not pair up: %s".formatted(key, line.substring(start)));
    }

    private static String unquoted(String value) {
        return value.startsWith("[") ? value.substring(1, value.length() - 1) : value;
    }

    private static String quoted(String value) {
        return value.chars().anyMatch(c -> Character.isWhitespace(c) || c == '[' || c == ']' || c == '=')
                ? "[" + value + "]"
                : value;
    }
}
