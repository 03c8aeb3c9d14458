// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import ij.ImageStack;
import ij.VirtualStack;
import ij.io.FileInfo;
import ij.process.ByteProcessor;
import ij.process.FloatProcessor;
import ij.process.ImageProcessor;
import ij.process.ShortProcessor;
import java.util.OptionalDouble;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.detection.DetectorException;

class ImageFilmTest {
    @Test
    void samplesAreLittleEndianRowByRow() {
        short[] shorts = {0x0102, (short) 0xfffe, 3, 4, 5, 6};
        assertThat(film(new ShortProcessor(3, 2, shorts, null)).frame(0))
                .containsExactly(2, 1, 0xfe, 0xff, 3, 0, 4, 0, 5, 0, 6, 0);
        assertThat(film(new ByteProcessor(2, 1, new byte[] {7, (byte) 200})).frame(0))
                .containsExactly(7, 200);
        assertThat(film(new FloatProcessor(1, 1, new float[] {1f})).frame(0)).containsExactly(0, 0, 0x80, 0x3f);
        assertThat(film(new FloatProcessor(1, 1)).sampleType()).isEqualTo(SampleType.FLOAT32);
    }

    @Test
    void framesOfAHyperstackAreThoseOfTheChannelAndTheRange() {
        // Value = 10 x channel + frame, both from 1.
        ImageStack stack = new ImageStack(1, 1);
        for (int frame = 1; frame <= 5; frame++) {
            for (int channel = 1; channel <= 2; channel++) {
                stack.addSlice(new ByteProcessor(1, 1, new byte[] {(byte) (10 * channel + frame)}));
            }
        }
        ImagePlus image = new ImagePlus("film", stack);
        image.setDimensions(2, 1, 5);
        ImageFilm film = new ImageFilm(
                image, new FilmOptions(FrameAxis.T, 2, 2, 4, OptionalDouble.empty(), OptionalDouble.empty()));
        assertThat(film.info().frameCount()).isEqualTo(3);
        assertThat(film.firstFrame()).isEqualTo(1);
        assertThat(film.frame(0)).containsExactly(22);
        assertThat(film.frame(2)).containsExactly(24);
    }

    @Test
    void aVirtualStackIsReadFrameByFrame() {
        VirtualStack stack = new VirtualStack(2, 1, null, "") {
            @Override
            public ImageProcessor getProcessor(int slice) {
                return new ByteProcessor(2, 1, new byte[] {(byte) slice, (byte) (2 * slice)});
            }

            @Override
            public int getSize() {
                return 9;
            }
        };
        ImagePlus image = new ImagePlus("virtual", stack);
        image.setDimensions(1, 1, 9);
        assertThat(new ImageFilm(image, FilmOptions.DEFAULTS).frame(8)).containsExactly(9, 18);
    }

    @Test
    void framesOnZAreTakenOnlyWhenAskedFor() {
        ImagePlus image = IJ.createImage("avi", "8-bit ramp", 4, 3, 6);
        assertThat(ImageFilm.framesLieOnZ(image)).isTrue();
        assertThatThrownBy(() -> new ImageFilm(image, FilmOptions.DEFAULTS))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("6 slices in Z")
                .hasMessageContaining("frames=z");
        FilmOptions onZ = new FilmOptions(FrameAxis.Z, 1, 1, 0, OptionalDouble.empty(), OptionalDouble.empty());
        assertThat(new ImageFilm(image, onZ).info().frameCount()).isEqualTo(6);
        image.setDimensions(1, 1, 6);
        assertThatThrownBy(() -> new ImageFilm(image, onZ)).hasMessageContaining("leave frames=z out");
        image.setDimensions(1, 2, 3);
        assertThatThrownBy(() -> new ImageFilm(image, FilmOptions.DEFAULTS)).hasMessageContaining("Z Project");
    }

    @Test
    void coloursMissingChannelsAndFramesAreRefused() {
        assertThatThrownBy(() -> new ImageFilm(IJ.createImage("rgb", "RGB", 4, 3, 1), FilmOptions.DEFAULTS))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("8-bit");
        ImagePlus image = IJ.createImage("grey", "8-bit", 4, 3, 5);
        image.setDimensions(1, 1, 5);
        assertThatThrownBy(() -> new ImageFilm(
                        image, new FilmOptions(FrameAxis.T, 2, 1, 0, OptionalDouble.empty(), OptionalDouble.empty())))
                .hasMessageContaining("channel 2");
        assertThatThrownBy(() -> new ImageFilm(
                        image, new FilmOptions(FrameAxis.T, 1, 2, 6, OptionalDouble.empty(), OptionalDouble.empty())))
                .hasMessageContaining("1 to 5 instead of 2 to 6");
    }

    @ParameterizedTest
    @CsvSource({
        "µm, 0.5, s, 0.25, 0.5, 0.25",
        "um, 0.5, sec, 0.25, 0.5, 0.25",
        "micron, 0.5, ms, 40, 0.5, 0.04",
        "microns, 0.5, min, 2, 0.5, 120",
        "nm, 250, msec, 16, 0.25, 0.016",
        "mm, 0.001, h, 1, 1, 3600",
        "cm, 0.0001, s, 1, 1, 1",
        "inch, 0.0009765625, s, 1, 24.8046875, 1",
        "mm, 0.25, s, 1, 250, 1"
    })
    void unitsAreConverted(
            String unit, double pixelWidth, String timeUnit, double interval, double micrometres, double seconds) {
        ImagePlus image = IJ.createImage("x", "8-bit", 4, 3, 1);
        image.getCalibration().setUnit(unit);
        image.getCalibration().pixelWidth = pixelWidth;
        image.getCalibration().pixelHeight = pixelWidth;
        image.getCalibration().setTimeUnit(timeUnit);
        image.getCalibration().frameInterval = interval;
        ImageFilm film = new ImageFilm(image, FilmOptions.DEFAULTS);
        assertThat(film.info().pixelSizeMicrometres()).hasValue(micrometres);
        assertThat(film.info().frameIntervalSeconds()).hasValue(seconds);
        assertThat(film.warnings()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource({"pixel, 1", "inch, 0.0138", "cm, 0.03528", "furlong, 3", "um, 0", "um, NaN"})
    void withoutCalibrationTheUserIsWarned(String unit, double pixelWidth) {
        ImagePlus image = IJ.createImage("x", "8-bit", 4, 3, 1);
        image.getCalibration().setUnit(unit);
        image.getCalibration().pixelWidth = pixelWidth;
        ImageFilm film = new ImageFilm(image, FilmOptions.DEFAULTS);
        assertThat(film.info().pixelSizeMicrometres()).isEmpty();
        assertThat(film.warnings()).singleElement().asString().contains("pixels per frame", "Image > Properties");
    }

    @Test
    void whatTheUserSaysGoesBeforeTheImage() {
        ImagePlus image = IJ.createImage("x", "8-bit", 4, 3, 1);
        image.getCalibration().setUnit("um");
        image.getCalibration().pixelWidth = 9;
        FilmOptions options = new FilmOptions(FrameAxis.T, 1, 1, 0, OptionalDouble.of(0.25), OptionalDouble.of(0.5));
        assertThat(new ImageFilm(image, options).info().pixelSizeMicrometres()).hasValue(0.25);
        assertThat(new ImageFilm(image, options).info().frameIntervalSeconds()).hasValue(0.5);
    }

    @Test
    void thePlaybackRateOfAnAviIsItsFrameIntervalAndThatOfAnotherFilmIsNot() {
        assertThat(playedAt30("film.AVI").info().frameIntervalSeconds()).hasValue(1 / 30.0);
        assertThat(playedAt30("film.AVI").warnings()).anyMatch(warning -> warning.contains("playback rate"));
        // Image > Stacks > Tools > Animation Options sets the rate too.
        assertThat(playedAt30("film.tif").info().frameIntervalSeconds()).isEmpty();
        assertThat(playedAt30("film.tif").warnings())
                .singleElement()
                .asString()
                .contains("give Pixel size (pixel_size) and Frame interval (frame_interval)");
    }

    private static ImageFilm playedAt30(String fileName) {
        ImagePlus image = IJ.createImage("x", "8-bit", 4, 3, 1);
        image.getCalibration().fps = 30;
        FileInfo source = new FileInfo();
        source.fileName = fileName;
        image.setFileInfo(source);
        return new ImageFilm(image, FilmOptions.DEFAULTS);
    }

    private static ImageFilm film(ImageProcessor frame) {
        return new ImageFilm(new ImagePlus("one", frame), FilmOptions.DEFAULTS);
    }
}
