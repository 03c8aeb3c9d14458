// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import ij.VirtualStack;
import ij.io.FileSaver;
import ij.plugin.FileInfoVirtualStack;
import java.io.File;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.detection.DetectorException;

class UnreadFileTest {
    @TempDir
    Path folder;

    @ParameterizedTest
    @ValueSource(strings = {"8-bit", "16-bit", "32-bit"})
    void aPictureOfAFolderThatIsGoneOrDamagedIsNamed(String type) throws Exception {
        Film film = film(type);
        assertThat(film.frame(1)).hasSize(40 * 30 * film.sampleType().bytes());

        Path second = folder.resolve("2.tif");
        Files.writeString(second, "no picture");
        assertThatThrownBy(() -> film.frame(1))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("Slice 2")
                .hasMessageContaining(second.toString());
        Files.delete(second);
        assertThatThrownBy(() -> film.frame(1)).hasMessageContaining(second.toString());
        assertThat(film.frame(2)).isNotEmpty();
    }

    @Test
    void aWhitePictureIsAFrame() throws Exception {
        Film film = film("8-bit white");
        assertThat(film.frame(0)).containsOnly(255);
    }

    @Test
    void aVirtualTiffThatIsGoneIsNamed() throws Exception {
        Path tiff = folder.resolve("film.tif");
        IJ.saveAsTiff(IJ.createImage("film", "8-bit ramp", 40, 30, 3), tiff.toString());
        ImagePlus image = FileInfoVirtualStack.openVirtual(tiff.toString());
        Film film = asFilm(image);
        assertThat(film.frame(2)).isNotEmpty();

        Files.delete(tiff);
        assertThatThrownBy(() -> film.frame(2)).hasMessageContaining(tiff.toString());
    }

    private Film film(String type) {
        VirtualStack stack = new VirtualStack(40, 30, null, folder + File.separator);
        for (int i = 1; i <= 3; i++) {
            String name = i + ".tif";
            new FileSaver(IJ.createImage(name, type, 40, 30, 1))
                    .saveAsTiff(folder.resolve(name).toString());
            stack.addSlice(name);
        }
        stack.setBitDepth(Integer.parseInt(type.replaceAll("\\D", "")));
        return asFilm(new ImagePlus("pictures", stack));
    }

    private static Film asFilm(ImagePlus image) {
        image.setDimensions(1, 1, image.getStackSize());
        return new ImageFilm(image, FilmOptions.DEFAULTS);
    }
}
