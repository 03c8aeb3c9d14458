// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.DetectorException;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.SampleType;

class ResultFilesTest {
    private static final Track TRACK = new Track(0, List.of(new TrackPoint(3, Box.around(20, 20, 8, 4), null)));

    @TempDir
    Path folder;

    @Test
    void theFolderIsMadeAndNothingIsLeftInIt() throws Exception {
        Path made = folder.resolve("ä [1]").resolve("细菌 b");
        ResultFiles files = ResultFiles.in(made, "my film.tif");
        assertThat(files.xml()).isEqualTo(made.resolve("my film.xml"));
        assertThat(files.all()).hasSize(6).doesNotHaveDuplicates();
        assertThat(made).isEmptyDirectory();
    }

    @Test
    void filesOfTheUserAreNotOverwritten() throws Exception {
        Files.writeString(folder.resolve("film.mdf"), "tracked by hand for a week");
        assertThatThrownBy(() -> ResultFiles.in(folder, "film.tif"))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.mdf");
    }

    @ParameterizedTest
    @ValueSource(strings = {"no JSON", "{}", "{\"a\": 1}", "{\"files\": {\"film.mdf\": \"0\"}}"})
    void aFileThatIsNamedAsOurProvenanceMakesNothingOurs(String json) throws Exception {
        Files.writeString(folder.resolve("film.json"), json);
        assertThatThrownBy(() -> ResultFiles.in(folder, "film.tif"))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.json");
    }

    @Test
    void resultsOfAnEarlierRunAreReplaced() throws Exception {
        ResultFiles files = ResultFiles.in(folder, "film.tif");
        write(files);
        Files.delete(files.picture());
        write(ResultFiles.in(folder, "film.tif"), TRACK);
        assertThat(Files.readString(files.csv())).hasLineCount(2);
        assertThat(folder).isDirectoryContaining(file -> file.equals(files.picture()));
        assertThat(folder.toFile().list()).hasSize(6);
    }

    @Test
    void tracksThatTheUserHasCorrectedAreNotOverwritten() throws Exception {
        ResultFiles files = ResultFiles.in(folder, "film.tif");
        write(files, TRACK);
        Files.writeString(files.xml(), "corrected by hand");
        assertThatThrownBy(() -> ResultFiles.in(folder, "film.tif"))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.xml")
                .hasMessageContaining("changed since");
    }

    @Test
    void norAreThoseThatTheUserCorrectsWhileARunWorks() throws Exception {
        write(ResultFiles.in(folder, "film.tif"));
        ResultFiles again = ResultFiles.in(folder, "film.tif");
        Files.writeString(again.mdf(), "corrected by hand");
        assertThatThrownBy(() -> write(again, TRACK)).hasMessageContaining("film.mdf");
        assertThat(again.mdf()).hasContent("corrected by hand");
        assertThat(folder.toFile().list()).hasSize(6);
    }

    @Test
    void aRunThatCannotBeWrittenLeavesTheEarlierOneAndTheNextRunWorks() throws Exception {
        ResultFiles files = ResultFiles.in(folder, "film.tif");
        write(files);
        String csv = Files.readString(files.csv());

        assertThatThrownBy(() -> writeWithoutItsLastFrame(ResultFiles.in(folder, "film.tif"), TRACK))
                .isInstanceOf(DetectorException.class);
        assertThat(files.csv()).hasContent(csv);
        assertThat(folder.toFile().list()).hasSize(6);
        write(ResultFiles.in(folder, "film.tif"), TRACK);
    }

    @Test
    void aFirstRunThatCannotBeWrittenLeavesNothing() throws Exception {
        assertThatThrownBy(() -> writeWithoutItsLastFrame(ResultFiles.in(folder, "film.tif"), TRACK))
                .isInstanceOf(DetectorException.class);
        assertThat(folder).isEmptyDirectory();
    }

    @Test
    void aFolderThatIsGoneIsTold() throws Exception {
        Path made = folder.resolve("made");
        ResultFiles files = ResultFiles.in(made, "film.tif");
        Files.delete(made);
        assertThatThrownBy(() -> write(files))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(made + " (it is gone)");
    }

    @Test
    void aFolderThatIsAFileIsRefused() throws Exception {
        Path file = Files.writeString(folder.resolve("file"), "x");
        assertThatThrownBy(() -> ResultFiles.in(file, "film.tif"))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(file.toString())
                .hasMessageContaining("choose another one");
    }

    @ParameterizedTest
    @CsvSource({
        "film.tif, film",
        "film.avi, film",
        "a.b.TIFF, a.b",
        "a/b:c, a_b_c",
        ".., film",
        "'  ', film",
        "细菌.tif, 细菌"
    })
    void namesAreThoseOfTheFilmWithoutWhatFileSystemsRefuse(String title, String expected) {
        assertThat(ResultFiles.baseName(title)).isEqualTo(expected);
    }

    private static void write(ResultFiles files, Track... tracks) {
        write(files, SmallRun.film(), tracks);
    }

    private static void writeWithoutItsLastFrame(ResultFiles files, Track... tracks) {
        Film film = SmallRun.film();
        write(
                files,
                new Film() {
                    @Override
                    public FilmInfo info() {
                        return film.info();
                    }

                    @Override
                    public SampleType sampleType() {
                        return film.sampleType();
                    }

                    @Override
                    public byte[] frame(int frame) {
                        throw new DetectorException("The film is gone.");
                    }
                },
                tracks);
    }

    private static void write(ResultFiles files, Film film, Track... tracks) {
        TrackingResult result = SmallRun.result(film, tracks);
        files.write(result, film, SmallRun.origin(film, result));
    }
}
