// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmInfo;

/** The files that the model server's tests take for ours are what we write; renew them where a writer changes on purpose. */
class ServerTestFilesTest {
    private static final Path FILES = Path.of("..", "model-server", "tests", "plugin_files");

    @TempDir
    Path folder;

    /** Five points, the second interpolated, and a single one; the stage drifts once they are gone. */
    private static TrackedFilm tracked() {
        FilmInfo film = new FilmInfo(
                "film",
                Optional.of(Path.of("/films/film.tif")),
                100,
                80,
                9,
                OptionalDouble.of(0.25),
                OptionalDouble.of(0.5));
        Track swimmer = new Track(
                0,
                List.of(
                        point(2, Box.around(10.5, 20.25, 30, 28), 0.75, Level.LOW),
                        new TrackPoint(3, Box.around(12, 21, 30, 28), null),
                        point(4, Box.around(13.5, 21.75, 30, 28), 0.5, Level.HIGH),
                        point(5, Box.around(15, 22.5, 30, 28), 0.625, Level.HIGH),
                        point(6, Box.around(16.5, 23.25, 30, 28), 0.5, Level.HIGH)));
        Track single = new Track(4, List.of(point(7, Box.around(40, 60.125, 30, 30), 0.875, Level.MEDIUM)));
        return TrackedFilm.of(film, List.of(swimmer, single), List.of(new FrameDetections(8, List.of(), 1, 0)));
    }

    private static TrackPoint point(int frame, Box box, double score, Level level) {
        return new TrackPoint(frame, box, new Detection(box, score, level, score - 1, score / 4));
    }

    @Test
    void csvIsAsTheServersTestsHaveIt() throws IOException {
        TrackCsv.write(folder.resolve("film.csv"), tracked());
        assertThat(folder.resolve("film.csv")).hasSameBinaryContentAs(FILES.resolve("film.csv"));
    }

    @Test
    void mdfIsAsTheServersTestsHaveIt() throws IOException {
        Mdf.write(folder.resolve("film.mdf"), tracked());
        assertThat(folder.resolve("film.mdf")).hasSameBinaryContentAs(FILES.resolve("film.mdf"));
    }

    /** But for the folder of the film, which Windows names otherwise. */
    @Test
    void trackMateXmlIsAsTheServersTestsHaveIt() throws IOException {
        TrackMateXml.write(folder.resolve("film.xml"), tracked());
        String written = Files.readString(folder.resolve("film.xml"));
        assertThat(written.replaceFirst("folder=\"[^\"]*\"", "folder=\"/films/\""))
                .isEqualTo(Files.readString(FILES.resolve("film.xml")));
    }
}
