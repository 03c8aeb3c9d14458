// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import org.memtrack.detection.Level;

/**
 * Reads what TrackMate's action "Export tracks to XML" writes: positions a track, frames from 0.
 *
 * <p>The file has units but no pixel size, so positions stay in its units.
 */
final class SimpleTracksReader {
    private SimpleTracksReader() {}

    /** Reads on from the root element. */
    static ImportedTracks read(XmlElements xml) throws FormatException {
        String version = xml.text("from").orElse("TrackMate of unknown version") + ", exported tracks";
        OptionalDouble interval = xml.number("frameInterval");
        OptionalDouble unit = Units.seconds(xml.text("timeUnits").orElse(""));
        List<List<ImportedSpot>> tracks = new ArrayList<>();
        int spotCount = 0;
        while (xml.next()) {
            switch (xml.name()) {
                case "particle" -> tracks.add(new ArrayList<>());
                case "detection" -> {
                    if (tracks.isEmpty()) {
                        throw xml.wrong("has a <detection> outside of a <particle>");
                    }
                    List<ImportedSpot> track = tracks.get(tracks.size() - 1);
                    ImportedSpot spot = readSpot(xml, spotCount++);
                    track.add(spot);
                }
                default -> {}
            }
        }
        List<ImportedTrack> imported = new ArrayList<>();
        for (int i = 0; i < tracks.size(); i++) {
            imported.add(ImportedTrack.chain(i, "Track_" + i, tracks.get(i)));
        }
        return new ImportedTracks(
                version,
                tracks.stream().flatMap(List::stream).toList(),
                imported,
                OptionalDouble.empty(),
                interval.isPresent() && interval.getAsDouble() > 0 && unit.isPresent()
                        ? OptionalDouble.of(interval.getAsDouble() * unit.getAsDouble())
                        : OptionalDouble.empty(),
                Optional.empty());
    }

    private static ImportedSpot readSpot(XmlElements xml, int id) throws FormatException {
        int frame = xml.requiredInteger("t");
        if (frame < 0) {
            throw xml.wrong("has the negative frame %d".formatted(frame));
        }
        return new ImportedSpot(
                id,
                frame,
                xml.requiredNumber("x"),
                xml.requiredNumber("y"),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                Level.UNSPECIFIED,
                false,
                true);
    }
}
