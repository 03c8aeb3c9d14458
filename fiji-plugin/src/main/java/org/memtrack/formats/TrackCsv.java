// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.OptionalDouble;
import java.util.function.Predicate;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
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
    static final String HEADER =
            "track,frame,time_s,x,y,x_um,y_um,width,height,score,level,position_error,interpolated,motility";

    private TrackCsv() {}

    /** Writes the tracks of a film, all or nothing. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        write(target, tracked, box -> true);
    }

    /**
     * Likewise.
     *
     * @param measured whether a box has the size of what was seen; of others the middle alone is written
     */
    public static void write(Path target, TrackedFilm tracked, Predicate<Box> measured) throws IOException {
        CsvFile.write(
                target,
                HEADER,
                IntStream.range(0, tracked.tracks().size()).boxed().flatMap(i -> rows(tracked, i, measured)));
    }

    private static Stream<List<String>> rows(TrackedFilm tracked, int index, Predicate<Box> measured) {
        Track track = tracked.tracks().get(index);
        TrackMotility motility = tracked.motility().get(index);
        return track.points().stream()
                .map(point -> cells(tracked.film(), track, point, measured.test(point.box()), motility));
    }

    private static List<String> cells(
            FilmInfo film, Track track, TrackPoint point, boolean measured, TrackMotility motility) {
        Box box = point.box();
        Detection detection = point.detection();
        return List.of(
                Integer.toString(track.id()),
                Integer.toString(point.frame()),
                seconds(point.frame(), film.frameIntervalSeconds()),
                decimal(box.centreX()),
                decimal(box.centreY()),
                times(box.centreX(), film.pixelSizeMicrometres()),
                times(box.centreY(), film.pixelSizeMicrometres()),
                measured ? decimal(box.width()) : "",
                measured ? decimal(box.height()) : "",
                detection == null ? "" : decimal(detection.score()),
                detection == null ? "" : word(detection.level()),
                detection == null || Double.isNaN(detection.error()) ? "" : decimal(detection.error()),
                point.interpolated() ? "1" : "0",
                motility.motilityClass().map(TrackCsv::word).orElse(""));
    }

    static String word(Enum<?> value) {
        return value.name().toLowerCase(Locale.ROOT);
    }

    static String times(double value, OptionalDouble unit) {
        return unit.isPresent() ? decimal(value * unit.getAsDouble()) : "";
    }

    /** To the microsecond, since at 20,000 frames a second one is 50 of them. */
    private static String seconds(int frame, OptionalDouble interval) {
        return interval.isPresent() ? decimal(frame * interval.getAsDouble(), 1_000_000) : "";
    }

    /** With four decimals. */
    static String decimal(double value) {
        return decimal(value, 10_000);
    }

    /**
     * Ten times as fast as the formatter of strings, which a long film feels.
     *
     * @param parts of one, a power of ten: as many decimals as it has noughts
     */
    private static String decimal(double value, long parts) {
        if (!(Math.abs(value) < 1e12)) {
            return Double.toString(value);
        }
        long units = Math.round(value * parts);
        String digits = Long.toString(parts + Math.abs(units) % parts);
        return (units < 0 ? "-" : "") + Math.abs(units) / parts + "." + digits.substring(1);
    }
}
