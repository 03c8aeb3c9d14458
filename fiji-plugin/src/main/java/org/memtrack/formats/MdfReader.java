// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.memtrack.detection.Level;

/** Reads MTrackJ data files of every version up to 1.5.1, with either line end. */
final class MdfReader {
    private static final Pattern HEADER = Pattern.compile("MTrackJ (\\S+) Data File\\s*");

    private final Path source;
    private final List<Track> tracks = new ArrayList<>();
    private String cluster = "1";
    private int lineNumber;
    private int spotCount;

    /** A track so far: of several points in one frame the last counts. */
    private record Track(String name, Map<Integer, ImportedSpot> spotOfFrame) {}

    private MdfReader(Path source) {
        this.source = source;
    }

    static ImportedTracks read(Path source) throws IOException {
        // Not strictly ASCII: nothing but numbers is read, whatever bytes a comment may hold.
        try (BufferedReader reader =
                new BufferedReader(new InputStreamReader(Files.newInputStream(source), StandardCharsets.ISO_8859_1))) {
            return new MdfReader(source).read(reader);
        }
    }

    private ImportedTracks read(BufferedReader reader) throws IOException {
        String version = readHeader(reader.readLine());
        for (String line = reader.readLine(); line != null; line = reader.readLine()) {
            lineNumber++;
            if (line.startsWith("End of MTrackJ")) {
                break;
            }
            String[] words = line.strip().split("\\s+");
            switch (words[0]) {
                case "Assembly" -> tracks.clear(); // of several, the last counts
                case "Cluster" -> cluster = word(words, 1);
                case "Track" ->
                    tracks.add(
                            new Track("Cluster %s Track %s".formatted(cluster, word(words, 1)), new LinkedHashMap<>()));
                case "Point" -> readPoint(words);
                case "", "Displaying", "Offset", "Reference", "Origin" -> {} // of the display, not of the tracks
                default -> throw wrong("starts with \"%s\", which MTrackJ does not write".formatted(words[0]));
            }
        }
        List<ImportedTrack> imported = new ArrayList<>();
        for (Track track : tracks) {
            imported.add(ImportedTrack.chain(imported.size(), track.name, List.copyOf(track.spotOfFrame.values())));
        }
        return new ImportedTracks(
                "MTrackJ " + version,
                imported.stream().flatMap(track -> track.spots().stream()).toList(),
                imported,
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                Optional.empty());
    }

    private String readHeader(String line) throws FormatException {
        lineNumber = 1;
        Matcher header = HEADER.matcher(line == null ? "" : line);
        if (!header.matches()) {
            throw wrong("should be \"MTrackJ <version> Data File\"; this is no file of MTrackJ");
        }
        String version = header.group(1);
        if (version.compareTo(MdfWriter.VERSION) > 0) {
            throw wrong("says version %s, but versions up to %s can be read".formatted(version, MdfWriter.VERSION));
        }
        return version;
    }

    private void readPoint(String[] words) throws FormatException {
        if (tracks.isEmpty()) {
            throw wrong("has a point before the first track");
        }
        double time = number(words, 5);
        long frame = Math.round(time) - 1;
        if (frame < 0 || frame > Integer.MAX_VALUE) {
            throw wrong("has the time %s; MTrackJ counts from 1".formatted(time));
        }
        ImportedSpot spot = new ImportedSpot(
                spotCount++,
                (int) frame,
                number(words, 2),
                number(words, 3),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                Level.UNSPECIFIED,
                time == Math.round(time) + MdfWriter.INTERPOLATED,
                true);
        tracks.get(tracks.size() - 1).spotOfFrame.put((int) frame, spot);
    }

    private double number(String[] words, int index) throws FormatException {
        try {
            double value = Double.parseDouble(word(words, index));
            if (Double.isFinite(value)) {
                return value;
            }
        } catch (NumberFormatException noNumber) {
            // Said below.
        }
        throw wrong("has \"%s\" where a number belongs".formatted(words[index]));
    }

    private String word(String[] words, int index) throws FormatException {
        if (index >= words.length) {
            throw wrong("ends after %d words".formatted(words.length));
        }
        return words[index];
    }

    private FormatException wrong(String what) {
        return new FormatException("%s: line %d %s".formatted(source, lineNumber, what));
    }
}
