// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.util.Optional;
import java.util.OptionalDouble;
import java.util.Random;
import java.util.concurrent.atomic.AtomicInteger;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.SampleType;

/** Noise that depends on the frame's number alone; counts how often frames are read. */
final class SyntheticFilm implements Film {
    final AtomicInteger framesRead = new AtomicInteger();
    private final FilmInfo info;
    private final SampleType type;

    SyntheticFilm(int width, int height, int frameCount, SampleType type) {
        this.info = new FilmInfo(
                "noise",
                Optional.empty(),
                width,
                height,
                frameCount,
                OptionalDouble.of(0.25),
                OptionalDouble.of(0.016));
        this.type = type;
    }

    @Override
    public FilmInfo info() {
        return info;
    }

    @Override
    public SampleType sampleType() {
        return type;
    }

    @Override
    public byte[] frame(int frame) {
        framesRead.incrementAndGet();
        byte[] samples = new byte[info.width() * info.height() * type.bytes()];
        new Random(frame).nextBytes(samples);
        return samples;
    }
}
