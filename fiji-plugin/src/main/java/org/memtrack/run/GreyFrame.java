// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.awt.image.BufferedImage;
import java.awt.image.DataBufferByte;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.stream.IntStream;
import org.memtrack.video.Film;
import org.memtrack.video.SampleType;

/** A frame of any sample type as an 8-bit picture. */
final class GreyFrame {
    /** Share of the pixels that may become black, and as many white, as ImageJ's own contrast does. */
    private static final double SATURATED = 0.00175;

    /** So many pixels, evenly spread, tell where black and white lie; a sorted copy of a huge frame would fill the memory. */
    private static final int ENOUGH = 1 << 17;

    private GreyFrame() {}

    static BufferedImage of(Film film, int frame) {
        ByteBuffer samples = ByteBuffer.wrap(film.frame(frame)).order(ByteOrder.LITTLE_ENDIAN);
        SampleType type = film.sampleType();
        int count = samples.remaining() / type.bytes();
        // Odd, since most widths are even: else a wide step would see but a few columns.
        int step = count / ENOUGH | 1;
        double[] sorted = IntStream.rangeClosed(0, (count - 1) / step)
                .mapToDouble(i -> sample(samples, type, i * step))
                .filter(Double::isFinite)
                .sorted()
                .toArray();
        double black = sorted.length == 0 ? 0 : sorted[(int) (SATURATED * (sorted.length - 1))];
        double white = sorted.length == 0 ? 1 : sorted[(int) Math.ceil((1 - SATURATED) * (sorted.length - 1))];
        double range = white > black ? white - black : 1;
        BufferedImage image =
                new BufferedImage(film.info().width(), film.info().height(), BufferedImage.TYPE_BYTE_GRAY);
        byte[] greys = ((DataBufferByte) image.getRaster().getDataBuffer()).getData();
        for (int i = 0; i < count; i++) {
            greys[i] = (byte) (int) Math.min(255, Math.max(0, (sample(samples, type, i) - black) / range * 255));
        }
        return image;
    }

    private static double sample(ByteBuffer samples, SampleType type, int index) {
        return switch (type) {
            case UINT8 -> samples.get(index) & 0xff;
            case UINT16 -> samples.getShort(2 * index) & 0xffff;
            case FLOAT32 -> samples.getFloat(4 * index);
        };
    }
}
