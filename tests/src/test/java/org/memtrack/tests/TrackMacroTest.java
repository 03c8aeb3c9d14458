// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import java.util.stream.IntStream;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.tests.Session.Outcome;

/** The macro command on the shaded jar, against a real server process. */
@Timeout(600)
class TrackMacroTest {
    private static final String SETTINGS = "preset=water min_length=15 pixel_size=0.25 frame_interval=0.02";

    @TempDir
    static Path folder;

    private static Path film;

    @BeforeAll
    static void makeAFilm() throws Exception {
        Path unusual = Files.createDirectories(folder.resolve("films [1] ü 细菌"));
        film = unusual.resolve("swimmers.tif");
        SwimmersFilm.save(film, 40, 300, 240);
    }

    @Test
    void aFilmBecomesTracksInFilesThatAgree() throws Exception {
        Path output = folder.resolve("out [2] ö 微生物");
        Outcome outcome =
                Session.run(FilmMacro.of(film, "output=[%s] %s".formatted(output, SETTINGS)), film.toString());

        assertThat(outcome.aborted()).isFalse();
        RunFiles files = new RunFiles(output, "swimmers");
        files.checkThatAllAgree();
        assertThat(files.tracks())
                .hasSize(SwimmersFilm.SWIMMERS)
                .allSatisfy(track -> assertThat(track.get("motility")).isEqualTo("high"));
        assertThat(files.points())
                .allSatisfy(
                        point -> assertThat(distanceToTheNearestSwimmer(point)).isLessThan(3));
        assertThat(files.provenance())
                .contains("\"min_length\": \"15\"")
                .contains("\"pixel_size_um\": 0.25")
                .contains("\"name\": \"default\"")
                .contains("openvino")
                .containsPattern("\"sha256\": \"[0-9a-f]{64}\"");
        assertThat(outcome.log())
                .contains("MEMTrack: %d tracks from".formatted(files.tracks().size()));
    }

    @Test
    void aSecondRunGivesTheSameAndTakesThePlaceOfTheFirst() throws Exception {
        Path output = folder.resolve("twice");
        String macro = FilmMacro.of(film, "output=[%s] %s".formatted(output, SETTINGS));
        Session.run(macro, film.toString());
        String first = Files.readString(output.resolve("swimmers.csv"));
        assertThat(Session.run(macro, film.toString()).aborted()).isFalse();
        assertThat(output.resolve("swimmers.csv")).hasContent(first);
    }

    @Test
    void aRangeOfFramesKeepsTheNumbersOfTheImageAndARegionItsPlace() throws Exception {
        Path output = folder.resolve("part");
        String options = "output=[%s] %s first_frame=11 last_frame=36".formatted(output, SETTINGS);
        String macro =
                FilmMacro.of(film, options).replaceFirst("options = ", "makeRectangle(0, 0, 150, 240);\noptions = ");
        assertThat(Session.run(macro, film.toString()).aborted()).isFalse();

        RunFiles files = new RunFiles(output, "swimmers");
        files.checkThatAllAgree();
        assertThat(files.points()).isNotEmpty().allSatisfy(point -> {
            assertThat(Integer.parseInt(point.get("frame"))).isBetween(10, 35);
            if (point.get("interpolated").equals("0")) {
                assertThat(Double.parseDouble(point.get("x"))).isLessThan(151);
                assertThat(Double.parseDouble(point.get("position_error"))).isBetween(0.001, 3.0);
            }
        });
    }

    @Test
    void nothingFoundIsAnHonestZero() throws Exception {
        Path output = folder.resolve("empty");
        String options = "output=[%s] threshold_low=1 threshold_medium=1 threshold_high=1".formatted(output);
        String macro = FilmMacro.of(film, options)
                .replaceFirst(
                        "options = ",
                        "run(\"Properties...\", \"unit=pixel pixel_width=1 pixel_height=1 frame=[0 sec]\");\noptions = ");
        Outcome outcome = Session.run(macro, film.toString());

        assertThat(outcome.aborted()).isFalse();
        assertThat(outcome.log())
                .containsPattern("0 tracks from 0 detections above 1.00; [1-9][0-9]* weaker boxes")
                .contains("lower the thresholds")
                .contains("pixel size and no frame interval");
        new RunFiles(output, "swimmers").checkThatAllAgree();
    }

    @Test
    void deepAndVirtualFilmsGiveWhatThePlainOneGives() throws Exception {
        Path pictures = Files.createDirectories(folder.resolve("frames"));
        String save = """
                open(getArgument());
                film = getImageID();
                getDimensions(width, height, channels, slices, frames);
                for (i = 1; i <= frames; i++) {
                    selectImage(film);
                    Stack.setFrame(i);
                    run("Duplicate...", "title=frame");
                    saveAs("PNG", "%s/" + IJ.pad(i, 4));
                    close();
                }
                """;
        assertThat(Session.run(save.formatted(pictures), film.toString()).aborted())
                .isFalse();
        Path fromFolder = folder.resolve("from-folder");
        Path from16 = folder.resolve("from-16");
        Path plain = folder.resolve("from-8");
        Session.run(FilmMacro.of(pictures, "output=[%s] %s".formatted(fromFolder, SETTINGS)), pictures.toString());
        Session.run(
                FilmMacro.of(film, "output=[%s] %s".formatted(from16, SETTINGS))
                        .replaceFirst(
                                "options = ", "setOption(\"ScaleConversions\", false); run(\"16-bit\");\noptions = "),
                film.toString());
        Session.run(FilmMacro.of(film, "output=[%s] %s".formatted(plain, SETTINGS)), film.toString());

        String expected = Files.readString(plain.resolve("swimmers.csv"));
        assertThat(fromFolder.resolve("frames.csv")).hasContent(expected);
        // Eight bits are resampled in whole numbers, sixteen are not: scores, and with them the order, may differ a
        // little.
        RunFiles deep = new RunFiles(from16, "swimmers");
        assertThat(deep.tracks()).hasSize(SwimmersFilm.SWIMMERS);
        assertThat(deep.points())
                .hasSameSizeAs(new RunFiles(plain, "swimmers").points())
                .allSatisfy(
                        point -> assertThat(distanceToTheNearestSwimmer(point)).isLessThan(3));
    }

    @Test
    void anAviIsTrackedWithItsFramesOnZ() throws Exception {
        Path avi = folder.resolve("swimmers [3].avi");
        Session.run(
                "open(getArgument()); run(\"AVI... \", \"compression=None frame=50 save=[%s]\");".formatted(avi),
                film.toString());
        Path output = folder.resolve("from-avi");
        Outcome outcome = Session.run(
                FilmMacro.of(avi, "output=[%s] preset=water min_length=15 pixel_size=0.25".formatted(output)),
                avi.toString());

        assertThat(outcome.aborted()).isFalse();
        assertThat(outcome.log()).contains("0.02000 s, is taken from the film's playback rate");
        RunFiles files = new RunFiles(output, "swimmers [3]");
        files.checkThatAllAgree();
        assertThat(files.tracks()).hasSize(SwimmersFilm.SWIMMERS);
    }

    @Test
    void realBacteriaInWaterAreTrackedEndToEnd() throws Exception {
        Path real = Examination.folder().resolve("bacteria_water").resolve("bacteria_water_TL.tif");
        Path output = folder.resolve("real");
        Outcome outcome = Session.run(
                FilmMacro.of(
                        real, "output=[%s] preset=water pixel_size=0.4545 frame_interval=0.0372".formatted(output)),
                real.toString());

        assertThat(outcome.aborted()).isFalse();
        RunFiles files = new RunFiles(output, "bacteria_water_TL");
        files.checkThatAllAgree();
        // About 24 bacteria a frame, most of them in view for 30 frames or more.
        assertThat(files.tracks()).hasSizeBetween(12, 60);
    }

    private static double distanceToTheNearestSwimmer(Map<String, String> point) {
        int frame = Integer.parseInt(point.get("frame"));
        double x = Double.parseDouble(point.get("x"));
        double y = Double.parseDouble(point.get("y"));
        return IntStream.range(0, SwimmersFilm.SWIMMERS)
                .mapToDouble(swimmer -> Math.hypot(
                        x - SwimmersFilm.x(swimmer, frame, 40, 300), y - SwimmersFilm.y(swimmer, frame, 240)))
                .min()
                .orElseThrow();
    }
}
