// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import ij.io.FileSaver;
import ij.plugin.FolderOpener;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Supplier;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.DetectorException;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.Provenance;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.ImageFilm;
import org.memtrack.video.SampleType;

class ResultFilesTest {
    private static final Track TRACK = new Track(0, List.of(new TrackPoint(3, Box.around(20, 20, 8, 4), null)));

    @TempDir
    Path folder;

    @TempDir
    Path disk;

    @Test
    void theFolderIsMadeAndNothingIsLeftInIt() throws Exception {
        Path made = folder.resolve("ä [1]").resolve("细菌 b");
        ResultFiles files = ResultFiles.in(made, opened(IJ.createImage("my film.tif", "8-bit", 60, 40, 9)));
        assertThat(files.xml()).isEqualTo(made.resolve("my film.xml"));
        assertThat(files.all()).hasSize(6).doesNotHaveDuplicates();
        assertThat(made).isEmptyDirectory();
    }

    @Test
    void filesOfTheUserAreNotOverwritten() throws Exception {
        Files.writeString(folder.resolve("film.mdf"), "tracked by hand for a week");
        assertThatThrownBy(() -> ResultFiles.in(folder, SmallRun.film()))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.mdf");
    }

    @ParameterizedTest
    @ValueSource(strings = {"no JSON", "{}", "{\"a\": 1}", "{\"files\": {\"film.mdf\": \"0\"}}"})
    void aFileThatIsNamedAsOurProvenanceMakesNothingOurs(String json) throws Exception {
        Files.writeString(folder.resolve("film.json"), json);
        assertThatThrownBy(() -> ResultFiles.in(folder, SmallRun.film()))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.json");
    }

    @Test
    void resultsOfAnEarlierRunAreReplaced() throws Exception {
        ResultFiles files = ResultFiles.in(folder, SmallRun.film());
        write(files);
        Files.delete(files.picture());
        write(ResultFiles.in(folder, SmallRun.film()), TRACK);
        assertThat(Files.readString(files.csv())).hasLineCount(2);
        assertThat(folder).isDirectoryContaining(file -> file.equals(files.picture()));
        assertThat(folder.toFile().list()).hasSize(6);
    }

    @Test
    void resultsOfAnotherFilmOfThatNameAreNotReplaced() throws Exception {
        Film one = saved("pos1", 1);
        Film other = saved("pos2", 2);
        write(ResultFiles.in(folder, one), one, TRACK);
        assertThatThrownBy(() -> ResultFiles.in(folder, other))
                .isInstanceOf(DetectorException.class)
                .hasMessage("%s holds the results of another film of this name, %s: give another output folder."
                        .formatted(folder, one.openedFrom().orElseThrow()));
        write(ResultFiles.in(folder, saved("pos1", 3)), one);
    }

    @Test
    void norAreThoseThatAnotherRunWritesMeanwhile() throws Exception {
        Film one = saved("pos1", 1);
        Film other = saved("pos2", 2);
        ResultFiles files = ResultFiles.in(folder, one);
        ResultFiles sameFiles = ResultFiles.in(folder, other);
        write(files, one, TRACK);
        assertThatThrownBy(() -> write(sameFiles, other)).hasMessageContaining("another film");
        assertThat(Files.readString(files.csv())).hasLineCount(2);
    }

    @Test
    void aFilmThatWasMovedOrCopiedIsTheSame() throws Exception {
        Film film = saved("before", 1);
        write(ResultFiles.in(folder, film), film);
        Film copy = saved("copy", 1);
        write(ResultFiles.in(folder, copy), copy);
        Files.delete(copy.openedFrom().orElseThrow());
        ResultFiles.in(folder, saved("after", 2));
    }

    @Test
    void picturesOfAnotherFolderAndACroppedFilmAreOtherFilms() throws Exception {
        Film one = pictures("pos1");
        Film other = pictures("pos2");
        write(ResultFiles.in(folder, one), one, TRACK);
        write(ResultFiles.in(folder, one), one, TRACK);
        assertThatThrownBy(() -> ResultFiles.in(folder, other))
                .hasMessageContaining(one.openedFrom().orElseThrow().toString());

        Film cropped = cropped(saved("pos3", 1));
        write(ResultFiles.in(folder, cropped), cropped);
        Film croppedLikewise = cropped(saved("pos4", 2));
        assertThatThrownBy(() -> ResultFiles.in(folder, croppedLikewise)).hasMessageContaining("pos3");
    }

    @ParameterizedTest
    @ValueSource(strings = {"\"C:\\u0000\"", "7", "null", "\"\""})
    void aFilmThatCannotBeLookedForIsNoReasonToRefuse(String file) throws Exception {
        Files.writeString(
                folder.resolve("film.json"),
                "{\"software\": {\"MEMTrack plug-in\": \"0.1.0\"}, \"film\": {\"file\": %s}, \"files\": {\"a\": \"0\"}}"
                        .formatted(file));
        ResultFiles.in(folder, saved("pos1", 1));
    }

    @Test
    void tracksThatTheUserHasCorrectedAreNotOverwritten() throws Exception {
        ResultFiles files = ResultFiles.in(folder, SmallRun.film());
        write(files, TRACK);
        Files.writeString(files.xml(), "corrected by hand");
        assertThatThrownBy(() -> ResultFiles.in(folder, SmallRun.film()))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.xml")
                .hasMessageContaining("changed since");
    }

    @Test
    void norAreThoseThatTheUserCorrectsWhileARunWorks() throws Exception {
        write(ResultFiles.in(folder, SmallRun.film()));
        ResultFiles again = ResultFiles.in(folder, SmallRun.film());
        Files.writeString(again.mdf(), "corrected by hand");
        assertThatThrownBy(() -> write(again, TRACK))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("film.mdf is there already")
                .hasMessageContaining("The results of this run were left in " + kept());
        assertThat(again.mdf()).hasContent("corrected by hand");
        assertThat(folder.toFile().list()).hasSize(7);
        assertThat(kept().toFile().list()).hasSize(6);
        assertThat(Files.readString(kept().resolve("film.csv"))).hasLineCount(2);
    }

    /** Where results lie that could not take their places. */
    private Path kept() {
        return folder.resolve(folder.toFile().list((in, name) -> name.endsWith(".part"))[0]);
    }

    @Test
    void aRunThatCannotBeWrittenLeavesTheEarlierOneAndTheNextRunWorks() throws Exception {
        ResultFiles files = ResultFiles.in(folder, SmallRun.film());
        write(files);
        String csv = Files.readString(files.csv());

        assertThatThrownBy(() -> writeWhatIsNoJson(ResultFiles.in(folder, SmallRun.film())))
                .isInstanceOf(IllegalArgumentException.class);
        assertThat(files.csv()).hasContent(csv);
        assertThat(folder.toFile().list()).hasSize(6);
        write(ResultFiles.in(folder, SmallRun.film()), TRACK);
    }

    @Test
    void aFirstRunThatCannotBeWrittenLeavesNothing() throws Exception {
        assertThatThrownBy(() -> writeWhatIsNoJson(ResultFiles.in(folder, SmallRun.film())))
                .isInstanceOf(IllegalArgumentException.class);
        assertThat(folder).isEmptyDirectory();
    }

    @Test
    void whereTheLastFrameCannotBeReadOrDrawnThePictureAloneIsMissing() throws Exception {
        Film gone = unreadable(() -> new DetectorException("The film is gone."));
        ResultFiles files = ResultFiles.in(folder, SmallRun.film());
        write(files);
        assertThat(write(files, gone, TRACK))
                .contains("The picture of the tracks is missing, since it could not be drawn (The film is gone);"
                        + " all other results are there.");
        assertThat(Files.readString(files.csv())).hasLineCount(2);
        assertThat(folder.toFile().list()).hasSize(5).doesNotContain("film.png");
        Provenance provenance = Provenance.read(files.provenance());
        assertThat(provenance.files()).containsOnlyKeys("film.xml", "film.csv", "film.motility.csv", "film.mdf");
        assertThat(provenance.warnings()).singleElement().asString().contains("The film is gone");

        Film huge = unreadable(() -> new OutOfMemoryError("Java heap space"));
        assertThat(write(ResultFiles.in(folder, SmallRun.film()), huge))
                .hasValueSatisfying(sentence -> assertThat(sentence).contains("(the memory is full)"));
        // What Java says where it has no fonts to write with.
        Film fontless = unreadable(() -> new InternalError("Fontconfig head is null"));
        assertThat(write(ResultFiles.in(folder, SmallRun.film()), fontless, TRACK))
                .hasValueSatisfying(sentence -> assertThat(sentence).contains("(Fontconfig head is null)"));
        assertThat(Files.readString(files.csv())).hasLineCount(2);
        assertThat(write(ResultFiles.in(folder, SmallRun.film()), SmallRun.film()))
                .isEmpty();
        assertThat(folder.toFile().list()).hasSize(6);
    }

    @Test
    void theDriftOfTheStageStandsInTheFileForTrackMate() throws Exception {
        Film film = SmallRun.film();
        ResultFiles files = ResultFiles.in(folder, film);
        TrackingResult drifting = SmallRun.result(film, List.of(new FrameDetections(2, List.of(), 4.5, -7)), TRACK);
        files.write(drifting, film, SmallRun.origin(film, drifting));
        assertThat(files.xml()).content().contains("MEMTRACK_DRIFT_X=\"4.5\" MEMTRACK_DRIFT_Y=\"-7.0\"");

        write(ResultFiles.in(folder, film), TRACK);
        assertThat(files.xml()).content().contains("<Spot ").doesNotContain("DRIFT");
    }

    @Test
    void aFolderThatIsGoneIsTold() throws Exception {
        Path made = folder.resolve("made");
        ResultFiles files = ResultFiles.in(made, SmallRun.film());
        Files.delete(made);
        assertThatThrownBy(() -> write(files))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(made + " (it is gone)");
    }

    @Test
    void aFolderThatIsAFileIsRefused() throws Exception {
        Path file = Files.writeString(folder.resolve("file"), "x");
        assertThatThrownBy(() -> ResultFiles.in(file, SmallRun.film()))
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

    /** Opened from film.tif in a folder beside that of the results; another value is other content. */
    private Film saved(String name, int value) throws IOException {
        Path file = Files.createDirectories(disk.resolve(name)).resolve("film.tif");
        ImagePlus image = IJ.createImage("film", "8-bit ramp", 60, 40, 9);
        image.getStack().getProcessor(5).set(7, 7, value);
        new FileSaver(image).saveAsTiffStack(file.toString());
        return opened(IJ.openImage(file.toString()));
    }

    private Film pictures(String name) throws IOException {
        Path pictures = Files.createDirectories(disk.resolve(name).resolve("frames"));
        for (int i = 0; i < 9; i++) {
            ImagePlus frame = IJ.createImage("frame", "8-bit ramp", 60, 40, 1);
            new FileSaver(frame).saveAsPng(pictures.resolve(i + ".png").toString());
        }
        return opened(FolderOpener.open(pictures.toString()));
    }

    private static Film cropped(Film film) {
        ImagePlus image = ((ImageFilm) film).image();
        image.setRoi(2, 2, 40, 30);
        image.setStack(image.crop("stack").getStack());
        image.deleteRoi();
        return opened(image);
    }

    private static Film opened(ImagePlus image) {
        image.setDimensions(1, 1, image.getStackSize());
        return new ImageFilm(image, FilmOptions.DEFAULTS);
    }

    private static void write(ResultFiles files, Track... tracks) {
        write(files, SmallRun.film(), tracks);
    }

    private static void writeWhatIsNoJson(ResultFiles files) {
        Film film = SmallRun.film();
        TrackingResult result = SmallRun.result(film, TRACK);
        files.write(result, film, Origin.of(film, result, Map.of("min_score", Double.NaN), List.of()));
    }

    /** The film of the small run when its frames can be read no more. */
    private static Film unreadable(Supplier<Throwable> failure) {
        Film film = SmallRun.film();
        return new Film() {
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
                Throwable thrown = failure.get();
                if (thrown instanceof Error error) {
                    throw error;
                }
                throw (RuntimeException) thrown;
            }
        };
    }

    private static Optional<String> write(ResultFiles files, Film film, Track... tracks) {
        TrackingResult result = SmallRun.result(film, tracks);
        return files.write(result, film, SmallRun.origin(film, result));
    }
}
