// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** A table of a run, read without the plug-in's own reader. */
final class TrackTable {
    private final List<String[]> cells = new ArrayList<>();

    TrackTable(Path csv) throws IOException {
        for (String line : Files.readAllLines(csv, StandardCharsets.UTF_8)) {
            cells.add(line.split(",", -1));
        }
    }

    /** Rows below the header, by the name of the column. */
    List<Map<String, String>> rows() {
        List<Map<String, String>> rows = new ArrayList<>();
        for (String[] row : cells.subList(1, cells.size())) {
            Map<String, String> named = new LinkedHashMap<>();
            for (int i = 0; i < row.length; i++) {
                named.put(cells.get(0)[i], row[i]);
            }
            rows.add(named);
        }
        return rows;
    }

    /** The table in columns, for people. */
    String describe() {
        StringBuilder text = new StringBuilder();
        for (String[] row : cells) {
            for (int i = 0; i < row.length; i++) {
                text.append(("%" + (width(i) + 2) + "s").formatted(row[i]));
            }
            text.append(System.lineSeparator());
        }
        return text.toString();
    }

    private int width(int column) {
        return cells.stream().mapToInt(row -> row[column].length()).max().orElse(0);
    }
}
