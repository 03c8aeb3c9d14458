// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;

import ij.IJ;
import ij.ImageJ;
import ij.ImagePlus;
import ij.io.FileSaver;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.OptionalDouble;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.DetectionSummary;
import org.memtrack.client.ModelInUse;
import org.memtrack.client.ServerInfo;
import org.memtrack.client.Thresholds;
import org.memtrack.detection.Box;
import org.memtrack.formats.Provenance;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.Film;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;
import org.memtrack.video.ImageFilm;

class OriginTest {
    @TempDir
    Path folder;

    @Test
    void pointsAreCountedAndNotTheFramesThatATrackSpans() {
        Film film = SmallRun.film();
        Box box = Box.around(20, 20, 8, 4);
        Track track = new Track(0, List.of(new TrackPoint(1, box, null), new TrackPoint(7, box, null)));
        assertThat(SmallRun.origin(film, SmallRun.result(film, track)).counts())
                .containsEntry("dropped_tracks", 3L)
                .containsEntry("tracks", 1L)
                .containsEntry("points", 2L)
                .containsEntry("interpolated_points", 2L);
    }

    @Test
    void itTellsFromWhereTheFramesOfTheFilmAreCounted() {
        ImagePlus image = IJ.createImage("film", "8-bit", 20, 10, 9);
        Film film = new ImageFilm(
                image, new FilmOptions(FrameAxis.Z, 1, 3, 0, OptionalDouble.empty(), OptionalDouble.empty()));
        assertThat(SmallRun.origin(film, SmallRun.result(film)).film())
                .containsEntry("first_frame", 2)
                .containsEntry("frames_count_from", 0);
    }

    @Test
    void aFilmThatNoFileHoldsTellsWhatItWasOpenedFrom() throws Exception {
        Path file = folder.resolve("film.tif");
        new FileSaver(IJ.createImage("film", "8-bit ramp", 20, 10, 9)).saveAsTiffStack(file.toString());
        ImagePlus image = IJ.openImage(file.toString());
        image.setDimensions(1, 1, 9);
        Film whole = new ImageFilm(image, FilmOptions.DEFAULTS);
        image.setRoi(1, 1, 8, 8);
        image.setStack(image.crop("stack").getStack());
        Film cropped = new ImageFilm(image, FilmOptions.DEFAULTS);

        assertThat(SmallRun.origin(whole, SmallRun.result(whole)).film())
                .containsEntry("file", file.toString())
                .doesNotContainKey("opened_from");
        assertThat(SmallRun.origin(cropped, SmallRun.result(cropped)).film())
                .containsEntry("opened_from", file.toString())
                .doesNotContainKey("file");
    }

    @Test
    void theImageJOfARunIsTheOneThatRuns() throws Exception {
        Film film = SmallRun.film();
        assertThat(SmallRun.origin(film, SmallRun.result(film)).software()).containsEntry("ImageJ", IJ.getVersion());
        try (Stream<Path> classes = Files.walk(Path.of("target", "classes", "org", "memtrack"))) {
            assertThat(classes.filter(file -> file.toString().endsWith(".class")))
                    .isNotEmpty()
                    .allSatisfy(file -> assertThat(Files.readString(file, StandardCharsets.ISO_8859_1))
                            .as("the version of the ImageJ that %s was compiled against", file)
                            .doesNotContain(ImageJ.VERSION));
        }
    }

    @Test
    void itTellsWhatEachStageTook() {
        Map<String, Double> seconds = Map.of("Background", 1.5, "Detecting", 20.25);
        DetectionSummary summary = new DetectionSummary(1, 9, 1, 2, 3, 1, 2, 0.2, "def", seconds, List.of());
        ModelInUse model =
                new ModelInUse("default", "5", "abc", new Thresholds(0.5, 0.6, 0.7), 1, "openvino", List.of());
        ServerInfo server = new ServerInfo(1, "0.1.0", "3.11", Map.of(), List.of(), 1, 1);
        Film film = new ImageFilm(
                IJ.createImage("film", "8-bit", 20, 10, 1),
                new FilmOptions(FrameAxis.T, 1, 1, 0, OptionalDouble.empty(), OptionalDouble.empty()));
        TrackingResult result = new TrackingResult(
                TrackedFilm.of(film.info(), List.of(), List.of()),
                0,
                new DetectionResult(List.of(), summary, model),
                server,
                List.of());

        Provenance provenance = Origin.of(film, result, Map.of(), List.of());

        assertThat(provenance.seconds()).isEqualTo(seconds);
        assertThat(provenance.counts()).containsEntry("near_misses", 2L);
    }
}
