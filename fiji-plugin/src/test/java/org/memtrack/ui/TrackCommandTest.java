// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import java.nio.file.Path;
import java.util.Map;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.function.BooleanSupplier;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.TrackRequest;
import org.memtrack.video.ImageFilm;

class TrackCommandTest {
    @TempDir
    Path folder;

    private final ImagePlus image = IJ.createImage("my film", "8-bit", 8, 8, 9);

    @BeforeEach
    void layTheFramesOnT() {
        image.setDimensions(1, 1, 9);
    }

    @Test
    void noOtherCommandGetsTheFilmWhileItIsTrackedAndThenTheyDo() {
        CompletableFuture<Boolean> othersMay = new CompletableFuture<>();
        Progress cancelledAtOnce = cancelledAfter(() -> othersMay.complete(inAnotherThread(image::lockSilently)));
        assertThatThrownBy(() -> TrackCommand.track(image, request(), cancelledAtOnce))
                .isInstanceOf(CancellationException.class);
        assertThat(othersMay).isCompletedWithValue(false);
        assertThat(inAnotherThread(image::lockSilently)).isTrue();
    }

    @Test
    void aFilmThatWasClosedWhileItIsTrackedKeepsItsFrames() {
        Progress closedMeanwhile = cancelledAfter(image::flush); // what the end of the window does
        assertThatThrownBy(() -> TrackCommand.track(image, request(), closedMeanwhile))
                .isInstanceOf(CancellationException.class);
        assertThat(image.getStack().getPixels(9)).isNotNull();
    }

    @Test
    void aFilmThatAnotherCommandWorksOnIsLeftToIt() {
        assertThat(inAnotherThread(image::lockSilently)).isTrue();
        assertThatThrownBy(() -> TrackCommand.track(image, request(), Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessage(
                        "Another command works on \"my film\" and has locked it: wait until it has ended; if it hangs,"
                                + " unlock the image with Plugins > Utilities > Reset.");
        assertThat(image.isLockedByAnotherThread()).isTrue();
        assertThat(folder).isEmptyDirectory();
    }

    @Test
    void othersGetTheFilmOnceItsLastFrameIsRead() {
        try (LockedImage locked = new LockedImage(image)) {
            ImageFilm film = locked.film(request().film());
            film.frame(7);
            assertThat(inAnotherThread(image::lockSilently)).isFalse();
            film.frame(8);
            assertThat(inAnotherThread(image::lockSilently)).isTrue();
        }
        assertThat(image.isLocked()).isTrue();
    }

    /** Of a run that is cancelled when it first reports, once something has happened. */
    private static Progress cancelledAfter(Runnable event) {
        return new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
                event.run();
                throw new CancellationException();
            }

            @Override
            public boolean cancelled() {
                return true;
            }
        };
    }

    private TrackRequest request() {
        return TrackRequest.of(Map.of("output", folder.toString()));
    }

    private static boolean inAnotherThread(BooleanSupplier work) {
        return CompletableFuture.supplyAsync(work::getAsBoolean).join();
    }
}
