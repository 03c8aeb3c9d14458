// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.awt.image.BufferedImage;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.Arrays;
import org.memtrack.video.Film;

/** A frame of any sample type as an 8-bit picture. */
final class GreyFrame {
    /** Share of the pixels that may become black, and as many white, as ImageJ's own contrast does. */
    private static final double SATURATED = 0.00175;

    private GreyFrame() {}

    static BufferedImage of(Film film, int frame) {
        double[] samples = samples(film, frame);
        double[] sorted =
                Arrays.stream(samples).filter(Double::isFinite).sorted().toArray();
        double black = sorted.length == 0 ? 0 : sorted[(int) (SATURATED * (sorted.length - 1))];
        double white = sorted.length == 0 ? 1 : sorted[(int) Math.ceil((1 - SATURATED) * (sorted.length - 1))];
        double range = white > black ? white - black : 1;
        int width = film.info().width();
        BufferedImage image = new BufferedImage(width, film.info().height(), BufferedImage.TYPE_BYTE_GRAY);
        for (int i = 0; i < samples.length; i++) {
            double grey = Math.min(255, Math.max(0, (samples[i] - black) / range * 255));
            image.getRaster().setSample(i % width, i / width, 0, (int) grey);
        }
        return image;
    }

    private static double[] samples(Film film, int frame) {
        ByteBuffer bytes = ByteBuffer.wrap(film.frame(frame)).order(ByteOrder.LITTLE_ENDIAN);
        double[] samples = new double[bytes.remaining() / film.sampleType().bytes()];
        for (int i = 0; i < samples.length; i++) {
            samples[i] = switch (film.sampleType()) {
                case UINT8 -> bytes.get() & 0xff;
                case UINT16 -> bytes.getShort() & 0xffff;
                case FLOAT32 -> bytes.getFloat();
            };
        }
        return samples;
    }
}
