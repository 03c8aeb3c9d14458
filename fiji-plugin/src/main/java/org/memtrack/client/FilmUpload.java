// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import com.google.protobuf.UnsafeByteOperations;
import java.util.Iterator;
import java.util.NoSuchElementException;
import org.memtrack.v1.DetectFilmRequest;
import org.memtrack.v1.FrameChunk;
import org.memtrack.video.Film;

/** The messages of the client for one film: the header, then its frames in chunks; holds one frame at a time. */
final class FilmUpload implements Iterator<DetectFilmRequest> {
    /** Large enough for throughput, small enough for flow control and the contract's 1 MiB. */
    private static final int CHUNK_BYTES = 512 * 1024;

    private final Film film;
    private final DetectionSettings settings;
    private final int frameBytes;
    private boolean headerSent;
    private int frame;
    private int offset;
    private byte[] samples = {};

    FilmUpload(Film film, DetectionSettings settings) {
        this.film = film;
        this.settings = settings;
        this.frameBytes = Math.multiplyExact(
                Math.multiplyExact(film.info().width(), film.info().height()),
                film.sampleType().bytes());
    }

    @Override
    public boolean hasNext() {
        return frame < film.info().frameCount();
    }

    @Override
    public DetectFilmRequest next() {
        if (!hasNext()) {
            throw new NoSuchElementException();
        }
        if (!headerSent) {
            headerSent = true;
            return DetectFilmRequest.newBuilder()
                    .setHeader(Messages.header(film, settings))
                    .build();
        }
        if (offset == 0) {
            samples = film.frame(frame);
            if (samples.length != frameBytes) {
                throw new IllegalStateException(
                        "Frame %d has %d bytes instead of %d".formatted(frame, samples.length, frameBytes));
            }
        }
        int length = Math.min(CHUNK_BYTES, frameBytes - offset);
        // Wrapped, not copied: nobody changes the samples any more.
        FrameChunk chunk = FrameChunk.newBuilder()
                .setFrame(frame)
                .setData(UnsafeByteOperations.unsafeWrap(samples, offset, length))
                .build();
        offset += length;
        if (offset == frameBytes) {
            offset = 0;
            frame++;
        }
        return DetectFilmRequest.newBuilder().setChunk(chunk).build();
    }
}
