// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.BufferedWriter;
import java.io.IOException;
import java.io.OutputStreamWriter;
import java.io.Writer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.Iterator;
import java.util.List;
import java.util.stream.Stream;

/** Writes a table of cells that hold no comma, quote or line end, in UTF-8. */
final class CsvFile {
    private CsvFile() {}

    /** Writes the header, then a line a row, all or nothing. */
    static void write(Path target, String header, Stream<List<String>> rows) throws IOException {
        AtomicFiles.write(target, out -> {
            Writer writer = new BufferedWriter(new OutputStreamWriter(out, StandardCharsets.UTF_8));
            writer.write(header + "\n");
            for (Iterator<List<String>> row = rows.iterator(); row.hasNext(); ) {
                writer.write(String.join(",", row.next()) + "\n");
            }
            writer.flush();
        });
    }
}
