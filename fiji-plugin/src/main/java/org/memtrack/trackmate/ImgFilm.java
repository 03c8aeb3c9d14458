// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import net.imglib2.Cursor;
import net.imglib2.RandomAccessibleInterval;
import net.imglib2.type.numeric.RealType;
import net.imglib2.type.numeric.integer.UnsignedByteType;
import net.imglib2.type.numeric.integer.UnsignedShortType;
import net.imglib2.view.Views;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.SampleType;

/** A film in ImgLib2's memory, as TrackMate hands it to detectors. */
final class ImgFilm implements Film {
    private final RandomAccessibleInterval<? extends RealType<?>> frames;
    private final FilmInfo info;
    private final int firstFrame;
    private final SampleType sampleType;

    /**
     * A range of frames.
     *
     * @param frames x, y and time
     * @param info of the range
     * @param firstFrame of the range, from 0
     */
    ImgFilm(RandomAccessibleInterval<? extends RealType<?>> frames, FilmInfo info, int firstFrame) {
        this.frames = frames;
        this.info = info;
        this.firstFrame = firstFrame;
        RealType<?> sample = frames.randomAccess().get();
        this.sampleType = sample instanceof UnsignedByteType
                ? SampleType.UINT8
                : sample instanceof UnsignedShortType ? SampleType.UINT16 : SampleType.FLOAT32;
    }

    @Override
    public FilmInfo info() {
        return info;
    }

    @Override
    public SampleType sampleType() {
        return sampleType;
    }

    @Override
    public int firstFrame() {
        return firstFrame;
    }

    @Override
    public byte[] frame(int frame) {
        ByteBuffer bytes = ByteBuffer.allocate(info.width() * info.height() * sampleType.bytes())
                .order(ByteOrder.LITTLE_ENDIAN);
        Cursor<? extends RealType<?>> pixels = rowByRow(frames, (long) firstFrame + frame);
        while (pixels.hasNext()) {
            float sample = pixels.next().getRealFloat();
            switch (sampleType) {
                case UINT8 -> bytes.put((byte) (int) sample);
                case UINT16 -> bytes.putShort((short) (int) sample);
                case FLOAT32 -> bytes.putFloat(sample);
            }
        }
        return bytes.array();
    }

    private static <T extends RealType<?>> Cursor<T> rowByRow(RandomAccessibleInterval<T> frames, long frame) {
        return Views.flatIterable(Views.hyperSlice(frames, 2, frame)).cursor();
    }
}
