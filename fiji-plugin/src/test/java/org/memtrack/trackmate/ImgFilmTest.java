// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Optional;
import java.util.OptionalDouble;
import net.imglib2.RandomAccessibleInterval;
import net.imglib2.img.array.ArrayImgs;
import net.imglib2.type.numeric.RealType;
import net.imglib2.view.Views;
import org.junit.jupiter.api.Test;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.SampleType;

class ImgFilmTest {
    private static ImgFilm film(RandomAccessibleInterval<? extends RealType<?>> frames, int firstFrame) {
        int count = (int) frames.dimension(2) - firstFrame;
        FilmInfo info = new FilmInfo(
                "test",
                Optional.empty(),
                (int) frames.dimension(0),
                (int) frames.dimension(1),
                count,
                OptionalDouble.empty(),
                OptionalDouble.empty());
        return new ImgFilm(frames, info, firstFrame);
    }

    @Test
    void framesAreReadRowByRowFromTheFirstOneOn() {
        ImgFilm film =
                film(ArrayImgs.unsignedBytes(new byte[] {9, 9, 9, 9, 9, 9, 1, 2, 3, 4, 5, (byte) 200}, 3, 2, 2), 1);
        assertThat(film.sampleType()).isEqualTo(SampleType.UINT8);
        assertThat(film.firstFrame()).isEqualTo(1);
        assertThat(film.frame(0)).containsExactly(1, 2, 3, 4, 5, (byte) 200);
    }

    @Test
    void rowsComeFirstWhateverTheOrderInMemory() {
        // Two columns and three rows, stored column by column.
        var columns = ArrayImgs.unsignedBytes(new byte[] {1, 2, 3, 4, 5, 6}, 3, 2, 1);
        assertThat(film(Views.permute(columns, 0, 1), 0).frame(0)).containsExactly(1, 4, 2, 5, 3, 6);
    }

    @Test
    void samplesAreLittleEndian() {
        ImgFilm shorts = film(ArrayImgs.unsignedShorts(new short[] {0x0102, (short) 0xfffe}, 2, 1, 1), 0);
        assertThat(shorts.sampleType()).isEqualTo(SampleType.UINT16);
        assertThat(shorts.frame(0)).containsExactly(2, 1, (byte) 0xfe, (byte) 0xff);

        ImgFilm floats = film(ArrayImgs.floats(new float[] {-1.5f}, 1, 1, 1), 0);
        assertThat(floats.sampleType()).isEqualTo(SampleType.FLOAT32);
        assertThat(floats.frame(0)).containsExactly(0, 0, (byte) 0xc0, (byte) 0xbf);
    }

    @Test
    void otherNumbersAreSentAsFloats() {
        ImgFilm doubles = film(ArrayImgs.doubles(new double[] {-1.5}, 1, 1, 1), 0);
        assertThat(doubles.sampleType()).isEqualTo(SampleType.FLOAT32);
        assertThat(doubles.frame(0)).containsExactly(0, 0, (byte) 0xc0, (byte) 0xbf);
    }
}
