// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.TreeMap;
import java.util.stream.Stream;
import org.memtrack.detection.Level;
import org.memtrack.motility.MotilityClass;

/** Reads what {@link TrackCsv} writes. */
final class TrackCsvReader {
    private TrackCsvReader() {}

    static ImportedTracks read(Path source) throws IOException {
        List<String> lines = Files.readAllLines(source);
        List<String> columns = List.of(lines.get(0).split(","));
        Map<Integer, ImportedTrack> tracks = new TreeMap<>();
        for (String line : lines.subList(1, lines.size())) {
            String[] row = line.split(",", -1);
            int id = Integer.parseInt(row[columns.indexOf("track")]);
            Optional<MotilityClass> motility = named(MotilityClass.values(), row[columns.indexOf("motility")]);
            tracks.computeIfAbsent(id, none -> new ImportedTrack(id, "", new ArrayList<>(), List.of(), motility))
                    .spots()
                    .add(new ImportedSpot(
                            0,
                            Integer.parseInt(row[columns.indexOf("frame")]),
                            Double.parseDouble(row[columns.indexOf("x")]),
                            Double.parseDouble(row[columns.indexOf("y")]),
                            number(row[columns.indexOf("width")]),
                            number(row[columns.indexOf("height")]),
                            number(row[columns.indexOf("score")]),
                            named(Level.values(), row[columns.indexOf("level")]).orElse(Level.UNSPECIFIED),
                            row[columns.indexOf("interpolated")].equals("1"),
                            OptionalDouble.empty(),
                            number(row[columns.indexOf("position_error")]),
                            OptionalDouble.empty(),
                            OptionalDouble.empty()));
        }
        return ImportedTracks.of("CSV", List.copyOf(tracks.values()));
    }

    private static OptionalDouble number(String cell) {
        return cell.isEmpty() ? OptionalDouble.empty() : OptionalDouble.of(Double.parseDouble(cell));
    }

    private static <E extends Enum<E>> Optional<E> named(E[] constants, String word) {
        return Stream.of(constants)
                .filter(constant -> constant.name().toLowerCase(Locale.ROOT).equals(word))
                .findFirst();
    }
}
