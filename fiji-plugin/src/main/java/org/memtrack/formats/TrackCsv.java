// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.TreeMap;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;
import org.memtrack.formats.CsvTable.Row;
import org.memtrack.motility.MotilityClass;
import org.memtrack.motility.TrackMotility;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmInfo;

/**
 * Tracks as a table: one header row, one row a point.
 *
 * <p>Columns without a unit in their name are pixels or frames. A cell is empty where the value is not known, and holds
 * nothing but numbers and our own words, so no spreadsheet takes one for a formula.
 */
public final class TrackCsv {
    static final String HEADER = "track,frame,time_s,x,y,x_um,y_um,width,height,score,level,interpolated,motility";

    private TrackCsv() {}

    /** Writes the tracks of a film, all or nothing. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        CsvFile.write(
                target,
                HEADER,
                IntStream.range(0, tracked.tracks().size()).boxed().flatMap(i -> rows(tracked, i)));
    }

    private static Stream<List<String>> rows(TrackedFilm tracked, int index) {
        Track track = tracked.tracks().get(index);
        return track.points().stream()
                .map(point ->
                        cells(tracked.film(), track, point, tracked.motility().get(index)));
    }

    private static List<String> cells(FilmInfo film, Track track, TrackPoint point, TrackMotility motility) {
        Box box = point.box();
        Detection detection = point.detection();
        return List.of(
                Integer.toString(track.id()),
                Integer.toString(point.frame()),
                times(point.frame(), film.frameIntervalSeconds()),
                decimal(box.centreX()),
                decimal(box.centreY()),
                times(box.centreX(), film.pixelSizeMicrometres()),
                times(box.centreY(), film.pixelSizeMicrometres()),
                decimal(box.width()),
                decimal(box.height()),
                detection == null ? "" : decimal(detection.score()),
                detection == null ? "" : word(detection.level()),
                point.interpolated() ? "1" : "0",
                motility.motilityClass().map(TrackCsv::word).orElse(""));
    }

    /**
     * Reads a table of this class, or the "Raw Data.csv" of the paper's authors (columns TID, PID, x [pixel], y [pixel],
     * where PID is the frame from 1, and perhaps Subpopulation).
     *
     * @throws FormatException when a column is missing or a cell holds what it cannot; the message has the line
     */
    public static ImportedTracks read(Path source) throws IOException {
        CsvTable table = CsvTable.read(source);
        boolean authors = table.column("tid") >= 0;
        int frameColumn = authors ? table.requiredColumn("pid") : table.requiredColumn("frame");
        int trackColumn = table.requiredColumn("track", "tid", "id", "track_id", "particle");
        int xColumn = table.requiredColumn("x", "x [pixel]", "x_px");
        int yColumn = table.requiredColumn("y", "y [pixel]", "y_px");
        int motilityColumn = table.column("motility", "subpopulation");
        Map<Integer, Map<Integer, ImportedSpot>> spotsOfTrack = new TreeMap<>();
        Map<Integer, Optional<MotilityClass>> motilityOfTrack = new LinkedHashMap<>();
        List<ImportedSpot> spots = new ArrayList<>();
        for (Row row : table.rows()) {
            int frame = table.requiredInteger(row, frameColumn) - (authors ? 1 : 0);
            if (frame < 0) {
                throw table.wrong(row, frameColumn, authors ? "a frame from 1" : "a frame from 0");
            }
            ImportedSpot spot = new ImportedSpot(
                    spots.size(),
                    frame,
                    table.requiredNumber(row, xColumn),
                    table.requiredNumber(row, yColumn),
                    table.number(row, table.column("width", "width_px")),
                    table.number(row, table.column("height", "height_px")),
                    table.number(row, table.column("score", "quality")),
                    level(table.text(row, table.column("level"))),
                    isTrue(table.text(row, table.column("interpolated"))),
                    true);
            int track = table.requiredInteger(row, trackColumn);
            spots.add(spot);
            if (track >= 0) { // -1 is a detection of no track
                motilityOfTrack.putIfAbsent(track, motility(table.text(row, motilityColumn)));
                if (spotsOfTrack.computeIfAbsent(track, id -> new TreeMap<>()).put(frame, spot) != null) {
                    throw table.wrong(row, frameColumn, "a frame that track %d does not have yet".formatted(track));
                }
            }
        }
        List<ImportedTrack> tracks = new ArrayList<>();
        spotsOfTrack.forEach(
                (id, ofTrack) -> tracks.add(ImportedTrack.chain(id, "Track_" + id, List.copyOf(ofTrack.values()))
                        .withMotility(motilityOfTrack.get(id))));
        return new ImportedTracks(
                authors ? "Raw Data.csv" : "CSV",
                spots,
                tracks,
                OptionalDouble.empty(),
                OptionalDouble.empty(),
                Optional.empty());
    }

    private static Level level(String word) {
        for (Level level : Level.values()) {
            if (word(level).equals(word.toLowerCase(Locale.ROOT))) {
                return level;
            }
        }
        return Level.UNSPECIFIED;
    }

    private static Optional<MotilityClass> motility(String word) {
        for (MotilityClass motilityClass : MotilityClass.values()) {
            String name = word(motilityClass);
            // The authors write the first letter.
            if (word.equalsIgnoreCase(name) || word.equalsIgnoreCase(name.substring(0, 1))) {
                return Optional.of(motilityClass);
            }
        }
        return Optional.empty();
    }

    private static boolean isTrue(String word) {
        return word.equals("1") || word.equalsIgnoreCase("true") || word.equals("1.0");
    }

    static String word(Enum<?> value) {
        return value.name().toLowerCase(Locale.ROOT);
    }

    static String times(double value, OptionalDouble unit) {
        return unit.isPresent() ? decimal(value * unit.getAsDouble()) : "";
    }

    /** With four decimals; ten times as fast as the formatter of strings, which a long film feels. */
    static String decimal(double value) {
        if (!(Math.abs(value) < 1e12)) {
            return Double.toString(value);
        }
        long units = Math.round(value * 10_000);
        String digits = Long.toString(10_000 + Math.abs(units) % 10_000);
        return (units < 0 ? "-" : "") + Math.abs(units) / 10_000 + "." + digits.substring(1);
    }
}
