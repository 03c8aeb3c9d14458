// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import static org.assertj.core.api.Assertions.assertThat;

import ij.IJ;
import ij.ImagePlus;
import ij.ImageStack;
import ij.io.FileInfo;
import ij.io.FileSaver;
import ij.plugin.FolderOpener;
import java.io.File;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class FilmFileTest {
    @TempDir
    Path folder;

    private Path file;
    private ImagePlus image;

    @BeforeEach
    void openAFilm() {
        file = folder.resolve("film.tif");
        new FileSaver(IJ.createImage("film", "8-bit ramp", 40, 30, 5)).saveAsTiffStack(file.toString());
        image = IJ.openImage(file.toString());
        image.setDimensions(1, 1, 5);
    }

    @Test
    void aFilmAsItWasOpenedHasItsFile() {
        assertThat(FilmFile.of(image).path()).hasValue(file);
        assertThat(FilmFile.of(image).warnings()).isEmpty();
    }

    @Test
    void aCroppedFilmHasNoneAndTheUserIsToldToSaveIt() {
        image.setRoi(2, 2, 36, 20);
        image.setStack(image.crop("stack").getStack());
        assertThatItHasNoFile();
    }

    @Test
    void aFilmThatLostASliceHasNoneEither() {
        ImageStack stack = image.getStack();
        stack.deleteSlice(2);
        image.setStack(stack);
        assertThatItHasNoFile();
    }

    @Test
    void anAviWhoseSizeImageJDoesNotSayHasItsFile() throws Exception {
        FileInfo source = new FileInfo();
        source.directory = folder + File.separator;
        source.fileName = "film.avi";
        Files.createFile(folder.resolve("film.avi"));
        image.setFileInfo(source);
        assertThat(FilmFile.of(image).path()).hasValue(folder.resolve("film.avi"));
    }

    @Test
    void aFilmThatWasNeverSavedHasNoneAndNothingIsSaid() {
        FilmFile none = FilmFile.of(IJ.createImage("new", "8-bit", 4, 3, 5));
        assertThat(none.path()).isEmpty();
        assertThat(none.openedFrom()).isEmpty();
        assertThat(none.warnings()).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "virtual"})
    void aFolderOfPicturesIsNoFileAndTheUserIsToldToSaveIt(String how) throws Exception {
        Path pictures = Files.createDirectory(folder.resolve("frames"));
        for (int i = 0; i < 3; i++) {
            new FileSaver(IJ.createImage("frame", "8-bit ramp", 40, 30, 1))
                    .saveAsPng(pictures.resolve(i + ".png").toString());
        }
        FilmFile none = FilmFile.of(FolderOpener.open(pictures.toString(), how));
        assertThat(none.path()).isEmpty();
        assertThat(none.openedFrom()).hasValue(pictures);
        assertThat(none.warnings())
                .containsExactly(
                        "\"frames\" was opened from single pictures, so the .xml names no film: save it as a TIFF first, and TrackMate finds it.");
    }

    private void assertThatItHasNoFile() {
        ImageFilm film = new ImageFilm(image, FilmOptions.DEFAULTS);
        assertThat(film.info().file()).isEmpty();
        assertThat(film.openedFrom()).hasValue(file);
        assertThat(film.warnings()).anySatisfy(warning -> assertThat(warning).contains(file.toString(), "save it"));
    }
}
