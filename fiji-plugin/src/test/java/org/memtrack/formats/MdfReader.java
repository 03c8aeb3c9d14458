// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import org.memtrack.detection.Level;

/** Reads what {@link Mdf} writes, as MTrackJ does: it rounds the time of a point to its frame. */
final class MdfReader {
    private MdfReader() {}

    static ImportedTracks read(Path source) throws IOException {
        List<String> lines = Files.readAllLines(source, StandardCharsets.US_ASCII);
        List<ImportedTrack> tracks = new ArrayList<>();
        String cluster = "";
        for (String line : lines) {
            String[] words = line.split(" ");
            switch (words[0]) {
                case "Cluster" -> cluster = words[1];
                case "Track" ->
                    tracks.add(new ImportedTrack(
                            tracks.size(),
                            "Cluster %s Track %s".formatted(cluster, words[1]),
                            new ArrayList<>(),
                            List.of(),
                            Optional.empty()));
                case "Point" -> tracks.get(tracks.size() - 1).spots().add(spot(words));
                default -> {}
            }
        }
        return ImportedTracks.of(lines.get(0).replace(" Data File", ""), tracks);
    }

    private static ImportedSpot spot(String[] words) {
        double time = Double.parseDouble(words[5]);
        return new ImportedSpot(
                Integer.parseInt(words[1]),
                (int) Math.round(time) - 1,
                Double.parseDouble(words[2]),
                Double.parseDouble(words[3]),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                Level.UNSPECIFIED,
                time != Math.round(time),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                OptionalDouble.empty());
    }
}
