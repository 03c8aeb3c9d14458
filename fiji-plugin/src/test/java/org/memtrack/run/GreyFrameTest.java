// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.sun.management.ThreadMXBean;
import ij.ImagePlus;
import ij.process.FloatProcessor;
import ij.process.ImageProcessor;
import ij.process.ShortProcessor;
import java.awt.image.BufferedImage;
import java.lang.management.ManagementFactory;
import org.junit.jupiter.api.Test;
import org.memtrack.video.Film;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.ImageFilm;

class GreyFrameTest {
    private static Film film(ImageProcessor frame) {
        return new ImageFilm(new ImagePlus("film", frame), FilmOptions.DEFAULTS);
    }

    private static int grey(BufferedImage picture, int x, int y) {
        return picture.getRaster().getSample(x, y, 0);
    }

    @Test
    void ofALargeFrameAsOfASmallOneAFewPixelsAreBlackOrWhite() {
        for (int edge : new int[] {200, 2000}) {
            ShortProcessor ramp = new ShortProcessor(edge, edge);
            for (int i = 0; i < edge * edge; i++) {
                ramp.set(i, (int) (60_000L * i / (edge * edge)));
            }
            BufferedImage picture = GreyFrame.of(film(ramp), 0);
            assertThat(grey(picture, 0, 0)).isZero();
            assertThat(grey(picture, 0, edge / 2)).isCloseTo(128, within(1));
            assertThat(grey(picture, edge - 1, edge - 1)).isEqualTo(255);
            assertThat(grey(picture, 0, edge / 100))
                    .as("1 of 100 is no more black")
                    .isPositive();
        }
    }

    @Test
    void whatIsNoNumberIsBlack() {
        float[] pixels = new float[400];
        for (int i = 0; i < 400; i++) {
            pixels[i] = i;
        }
        pixels[399] = Float.NaN;
        pixels[398] = Float.POSITIVE_INFINITY;
        BufferedImage picture = GreyFrame.of(film(new FloatProcessor(20, 20, pixels)), 0);
        assertThat(grey(picture, 19, 19)).isZero();
        assertThat(grey(picture, 18, 19)).isEqualTo(255);
        assertThat(grey(picture, 0, 10)).isCloseTo(128, within(2));
    }

    @Test
    void aLargeFrameTakesLittleMoreMemoryThanItsSamples() {
        Film film = film(new ShortProcessor(4000, 4000));
        ThreadMXBean threads = (ThreadMXBean) ManagementFactory.getThreadMXBean();
        long before = threads.getCurrentThreadAllocatedBytes();
        byte[] samples = film.frame(0);
        long toRead = threads.getCurrentThreadAllocatedBytes() - before;
        assertThat(toRead).isGreaterThanOrEqualTo(samples.length);
        GreyFrame.of(film, 0);
        assertThat(threads.getCurrentThreadAllocatedBytes() - before - 2 * toRead)
                .as("beyond the samples: the picture, a byte a pixel, and what the contrast is taken from")
                .isLessThan(2 * 4000 * 4000);
    }
}
