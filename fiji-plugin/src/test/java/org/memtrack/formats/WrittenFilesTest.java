// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmInfo;

/** What stands in the files for other programs to read. */
class WrittenFilesTest {
    @TempDir
    Path folder;

    private final TrackedFilm tracked = TrackedWorlds.of(1, true, Interpolation.FILL_GAPS);

    @Test
    void mdfIsAsciiWithCarriageReturnsAndColours() throws IOException {
        Path file = folder.resolve("tracks.mdf");

        Mdf.write(file, tracked);

        String text = Files.readString(file, StandardCharsets.US_ASCII);
        assertThat(text.split("\r\n")[0]).isEqualTo("MTrackJ 1.5.1 Data File");
        assertThat(text).endsWith("End of MTrackJ Data File\r\n");
        assertThat(text.replace("\r\n", "")).doesNotContain("\n", "\r");
        assertThat(text.lines().filter(line -> line.startsWith("Track ")))
                .hasSameSizeAs(tracked.tracks())
                .allMatch(line -> line.matches("Track \\d+ [0-9A-F]{6} true"));
        assertThat(text.lines().filter(line -> line.startsWith("Point ")))
                .allMatch(line -> line.matches("Point \\d+ -?\\d+\\.\\d{4} -?\\d+\\.\\d{4} 1\\.0 \\d+\\.(0|25) 1\\.0"));
    }

    @Test
    void ofABoxThatIsNoMeasurementTheTableHasTheMiddleAlone() throws IOException {
        Path file = folder.resolve("tracks.csv");
        Box first = tracked.tracks().get(0).points().get(0).box();

        TrackCsv.write(file, tracked, box -> !box.equals(first));

        List<String> lines = Files.readAllLines(file);
        assertThat(lines.get(1))
                .contains(",%s,,,"
                        .formatted(
                                TrackCsv.times(first.centreY(), tracked.film().pixelSizeMicrometres())));
        assertThat(lines.subList(2, lines.size())).allMatch(row -> row.matches("([^,]*,){7}[0-9.]+,[0-9.]+,.*"));
    }

    @Test
    void csvHasOneHeaderRowAndNoCellThatASpreadsheetCouldRun() throws IOException {
        Path file = folder.resolve("tracks.csv");
        Path motility = folder.resolve("motility.csv");

        TrackCsv.write(file, tracked);
        MotilityCsv.write(motility, tracked);

        List<String> lines = Files.readAllLines(file);
        assertThat(lines.get(0)).isEqualTo(TrackCsv.HEADER);
        assertThat(lines)
                .hasSize(1
                        + tracked.tracks().stream()
                                .mapToInt(track -> track.points().size())
                                .sum());
        assertThat(Files.readAllLines(motility)).hasSize(1 + tracked.tracks().size());
        for (Path table : List.of(file, motility)) {
            List<String> rows = Files.readAllLines(table);
            int columns = rows.get(0).split(",").length;
            for (String row : rows.subList(1, rows.size())) {
                assertThat(row.split(",", -1))
                        .hasSize(columns)
                        .allMatch(cell -> cell.matches("-?\\d+(\\.\\d+)?|[a-z]*"));
            }
        }
    }

    @Test
    void numbersHaveFourDecimalsAndTheirSign() {
        assertThat(TrackCsv.decimal(12.34567)).isEqualTo("12.3457");
        assertThat(TrackCsv.decimal(-0.00005001)).isEqualTo("-0.0001");
        assertThat(TrackCsv.decimal(-0.00001)).isEqualTo("0.0000");
        assertThat(TrackCsv.decimal(-3.05)).isEqualTo("-3.0500");
        assertThat(TrackCsv.decimal(1e13)).isEqualTo("1.0E13");
    }

    @Test
    void timesTellTheFramesOfAFastCameraApart() throws IOException {
        FilmInfo fast = new FilmInfo(
                "fast", Optional.empty(), 100, 80, 4, OptionalDouble.empty(), OptionalDouble.of(1 / 20_000.0));
        Track track = new Track(
                0,
                IntStream.range(0, 4)
                        .mapToObj(frame -> new TrackPoint(frame, Box.around(10, 10, 8, 8), null))
                        .toList());
        Path file = folder.resolve("fast.csv");
        TrackCsv.write(file, TrackedFilm.of(fast, List.of(track), List.of()));
        assertThat(Files.readAllLines(file).stream().skip(1).map(row -> row.split(",")[2]))
                .containsExactly("0.000000", "0.000050", "0.000100", "0.000150");
    }

    @Test
    void numbersDoNotDependOnTheLanguageOfTheSystem() throws IOException {
        Path english = folder.resolve("english.csv");
        Path german = folder.resolve("german.csv");
        TrackCsv.write(english, tracked);
        Locale before = Locale.getDefault();
        try {
            Locale.setDefault(Locale.GERMANY);
            TrackCsv.write(german, tracked);
        } finally {
            Locale.setDefault(before);
        }

        assertThat(german).hasSameTextualContentAs(english);
    }

    @Test
    void trackMateXmlDeclaresEveryFeatureItUses() throws IOException {
        Path file = folder.resolve("tracks.xml");

        TrackMateXml.write(file, tracked);

        String text = Files.readString(file);
        for (SpotFeature feature : SpotFeature.values()) {
            if (feature.isDrift()) {
                assertThat(text).as("a stage that stands still").doesNotContain(feature.key());
                continue;
            }
            assertThat(text).contains("feature=\"" + feature.key() + "\"").contains(feature.key() + "=\"");
        }
        assertThat(text).contains("feature=\"LINK_COST\"").contains("DETECTOR_NAME=\"MANUAL_DETECTOR\"");
        // Without it TrackMate reports errors in the file.
        assertThat(text).contains("<DisplaySettings/>");
    }

    @Test
    void theLagSpeedIsNamedByItsLag() throws IOException {
        assertThat(lagSpeedName(OptionalDouble.of(1 / 60.0))).isEqualTo("Mean speed over 0.1 s");
        assertThat(lagSpeedName(OptionalDouble.of(1 / 26.87))).isEqualTo("Mean speed over 0.112 s");
        assertThat(lagSpeedName(OptionalDouble.of(1.5))).isEqualTo("Mean speed over 1.5 s");
        assertThat(lagSpeedName(OptionalDouble.of(20))).isEqualTo("Mean speed over 20 s");
        assertThat(lagSpeedName(OptionalDouble.empty())).isEqualTo("Mean speed over 6 frames");
    }

    private String lagSpeedName(OptionalDouble interval) throws IOException {
        FilmInfo film = new FilmInfo("film", Optional.empty(), 100, 80, 1, OptionalDouble.empty(), interval);
        Detection detection = new Detection(Box.around(50, 60, 10, 12), 0.9, Level.LOW);
        Track track = new Track(0, List.of(new TrackPoint(0, detection.box(), detection)));
        Path file = folder.resolve("lag.xml");
        TrackMateXml.write(file, TrackedFilm.of(film, List.of(track), List.of()));
        return Files.readString(file).replaceFirst("(?s).*\"MEMTRACK_LAG_SPEED\" name=\"([^\"]*)\".*", "$1");
    }

    @Test
    void aSpeedThatWasNotMeasuredIsAnEmptyCell() throws IOException {
        Detection detection = new Detection(Box.around(50, 60, 10, 12), 0.9, Level.LOW);
        Track track = new Track(0, List.of(new TrackPoint(3, detection.box(), detection)));
        FilmInfo film =
                new FilmInfo("film", Optional.empty(), 100, 80, 6, OptionalDouble.of(0.25), OptionalDouble.of(0.5));
        Path file = folder.resolve("motility.csv");

        MotilityCsv.write(file, TrackedFilm.of(film, List.of(track), List.of()));

        assertThat(Files.readAllLines(file)).last().isEqualTo("0,3,3,1,0,,,1,,,,");
    }

    @Test
    void trackMateXmlHasTheDriftOfTheStageOnEverySpot() throws IOException {
        Detection before = new Detection(Box.around(50, 60, 10, 12), 0.9, Level.LOW);
        Detection after = new Detection(Box.around(71, 30, 10, 12), 0.9, Level.LOW);
        List<FrameDetections> frames = List.of(
                new FrameDetections(3, List.of(before)),
                new FrameDetections(4, List.of(), 20, -30),
                new FrameDetections(5, List.of(after), 20, -30));
        Track track = new Track(
                0,
                List.of(
                        new TrackPoint(3, before.box(), before),
                        new TrackPoint(4, Box.around(70, 30, 10, 12), null),
                        new TrackPoint(5, after.box(), after)));
        FilmInfo film =
                new FilmInfo("film", Optional.empty(), 100, 80, 6, OptionalDouble.of(0.25), OptionalDouble.of(0.5));
        Path file = folder.resolve("tracks.xml");

        TrackMateXml.write(file, TrackedFilm.of(film, List.of(track), frames));

        assertThat(Files.readString(file).lines().filter(line -> line.contains("<Spot ")))
                .satisfiesExactly(
                        spot -> assertThat(spot).contains("DRIFT_X=\"0.0\"", "DRIFT_Y=\"0.0\""),
                        spot -> assertThat(spot).contains("DRIFT_X=\"5.0\"", "DRIFT_Y=\"-7.5\""),
                        spot -> assertThat(spot).contains("DRIFT_X=\"5.0\"", "DRIFT_Y=\"-7.5\""));
        assertThat(file).content().contains("feature=\"MEMTRACK_DRIFT_X\"", "feature=\"MEMTRACK_DRIFT_Y\"");
    }

    @Test
    void aWriterThatFailsLeavesTheOldFileAndNothingElse() throws IOException {
        Path target = Files.writeString(folder.resolve("tracks.csv"), "old");

        assertThatThrownBy(() -> AtomicFiles.write(target, out -> {
                    out.write(1);
                    throw new IOException("disk full");
                }))
                .hasMessage("disk full");

        assertThat(target).hasContent("old");
        try (Stream<Path> files = Files.list(folder)) {
            assertThat(files).containsExactly(target);
        }
    }

    @Test
    void anOlderFileIsReplaced() throws IOException {
        Path target = Files.writeString(folder.resolve("tracks.csv"), "old");

        TrackCsv.write(target, tracked);

        assertThat(Files.readString(target)).startsWith(TrackCsv.HEADER);
    }

    @Test
    void aFolderThatDoesNotExistIsAnIoException() {
        assertThatThrownBy(() -> Mdf.write(folder.resolve("none").resolve("tracks.mdf"), tracked))
                .isInstanceOf(IOException.class);
    }

    @Test
    void provenanceKeepsWhatItIsGiven() throws IOException {
        Provenance provenance = new Provenance(
                "2026-11-22T02:00:00Z",
                Map.of("plug-in", "0.1.0"),
                Map.of("title", "Wässer <水>", "width", 660L, "pixel_size_um", 0.2475),
                Map.of("name", "default", "thresholds", List.of(0.5, 0.25)),
                Map.of("maximum_age", 25L),
                Map.of("tracks", 12L),
                Map.of("Detecting", 20.25),
                List.of("No calibration."),
                Map.of("tracks.csv", "5e".repeat(32)));
        Path file = folder.resolve("tracks.json");

        provenance.write(file);

        assertThat(Provenance.read(file)).isEqualTo(provenance);
        assertThat(Files.readString(file)).contains("Wässer <水>");
    }

    @Test
    void aFileThatIsNoProvenanceIsNamed() throws IOException {
        Path file = Files.writeString(folder.resolve("tracks.json"), "[1, 2");
        Path empty = Files.writeString(folder.resolve("empty.json"), "");

        assertThatThrownBy(() -> Provenance.read(file))
                .isInstanceOf(FormatException.class)
                .hasMessageContaining("is no provenance");
        assertThatThrownBy(() -> Provenance.read(empty)).hasMessageContaining("it is empty");
    }
}
