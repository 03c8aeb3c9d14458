// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.OptionalDouble;

/**
 * A table of text with one header row; columns are found by name, without regard to case.
 *
 * <p>Cells are parted by commas, semicolons or tabs, whichever the header has most of, and may stand in double quotes.
 */
final class CsvTable {
    private final Path source;
    private final List<String> header;
    private final List<Row> rows = new ArrayList<>();

    /** One row with the number of its line. */
    record Row(int line, List<String> cells) {}

    private CsvTable(Path source, List<String> header) {
        this.source = source;
        this.header = header;
    }

    static CsvTable read(Path source) throws IOException {
        try (BufferedReader reader =
                new BufferedReader(new InputStreamReader(Files.newInputStream(source), StandardCharsets.UTF_8))) {
            String first = reader.readLine();
            if (first == null) {
                throw new FormatException("%s is empty; a table of tracks has a header row".formatted(source));
            }
            if (first.startsWith("\ufeff")) {
                first = first.substring(1); // the byte order mark that spreadsheets write
            }
            char separator = separatorOf(first);
            List<String> header = cellsOf(first, separator).stream()
                    .map(name -> name.toLowerCase(Locale.ROOT))
                    .toList();
            CsvTable table = new CsvTable(source, header);
            int number = 1;
            for (String line = reader.readLine(); line != null; line = reader.readLine()) {
                number++;
                if (!line.isBlank()) {
                    table.rows.add(new Row(number, cellsOf(line, separator)));
                }
            }
            return table;
        }
    }

    List<Row> rows() {
        return rows;
    }

    /** Index of the first of these columns that the table has, or -1. */
    int column(String... names) {
        for (String name : names) {
            if (header.contains(name)) {
                return header.indexOf(name);
            }
        }
        return -1;
    }

    /** As {@link #column}, for a column that must be there. */
    int requiredColumn(String... names) throws FormatException {
        int column = column(names);
        if (column < 0) {
            throw new FormatException("%s has no column \"%s\", only %s".formatted(source, names[0], header));
        }
        return column;
    }

    /** Text of a cell, empty when the table has no such column. */
    String text(Row row, int column) {
        return column >= 0 && column < row.cells.size() ? row.cells.get(column) : "";
    }

    /** A finite number; empty for an empty cell, NA or NaN. */
    OptionalDouble number(Row row, int column) throws FormatException {
        String text = text(row, column);
        if (text.isEmpty() || text.equalsIgnoreCase("na") || text.equalsIgnoreCase("nan")) {
            return OptionalDouble.empty();
        }
        try {
            double value = Double.parseDouble(text);
            if (Double.isFinite(value)) {
                return OptionalDouble.of(value);
            }
        } catch (NumberFormatException noNumber) {
            // Said below.
        }
        throw wrong(row, column, "a number");
    }

    double requiredNumber(Row row, int column) throws FormatException {
        OptionalDouble value = number(row, column);
        if (value.isEmpty()) {
            throw wrong(row, column, "a number");
        }
        return value.getAsDouble();
    }

    /** A whole number, also when it is written as 3.0. */
    int requiredInteger(Row row, int column) throws FormatException {
        double value = requiredNumber(row, column);
        if (value != Math.rint(value) || Math.abs(value) > Integer.MAX_VALUE) {
            throw wrong(row, column, "a whole number");
        }
        return (int) value;
    }

    FormatException wrong(Row row, int column, String expected) {
        return new FormatException("%s: line %d has \"%s\" in the column \"%s\", where %s belongs"
                .formatted(source, row.line, text(row, column), header.get(column), expected));
    }

    private static char separatorOf(String header) {
        char best = ',';
        for (char candidate : new char[] {';', '\t'}) {
            if (count(header, candidate) > count(header, best)) {
                best = candidate;
            }
        }
        return best;
    }

    private static long count(String text, char wanted) {
        return text.chars().filter(c -> c == wanted).count();
    }

    private static List<String> cellsOf(String line, char separator) {
        List<String> cells = new ArrayList<>();
        StringBuilder cell = new StringBuilder();
        boolean quoted = false;
        for (int i = 0; i < line.length(); i++) {
            char c = line.charAt(i);
            if (c == '"') {
                quoted = !quoted;
            } else if (c == separator && !quoted) {
                cells.add(cell.toString().strip());
                cell.setLength(0);
            } else {
                cell.append(c);
            }
        }
        cells.add(cell.toString().strip());
        return cells;
    }
}
