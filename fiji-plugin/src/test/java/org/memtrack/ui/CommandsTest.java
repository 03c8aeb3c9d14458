// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import ij.Macro;
import java.awt.GraphicsEnvironment;
import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.util.concurrent.CancellationException;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.DetectorException;

class CommandsTest {
    @BeforeAll
    static void withoutAWindow() {
        assumeTrue(GraphicsEnvironment.isHeadless(), "With a window the sentence waits for OK.");
    }

    @Test
    void aFailureIsOneSentenceAndStopsTheMacro() {
        assertThat(said(() -> {
                    throw new DetectorException("No film is open: open one first.");
                }))
                .isEqualTo("MEMTrack: No film is open: open one first.");
    }

    @Test
    void soIsAMemoryThatIsFull() {
        assertThat(said(() -> {
                    throw new OutOfMemoryError("Java heap space");
                }))
                .matches(
                        "MEMTrack: The memory of ImageJ \\(\\d+ MB\\) is full: close other images, .*, and run again\\.");
    }

    @Test
    void soIsAnyOtherError() {
        assertThat(said(() -> {
                    throw new NoClassDefFoundError("ij/measure/Calibration");
                }))
                .startsWith("MEMTrack: MEMTrack failed unexpectedly")
                .contains("ij/measure/Calibration")
                .endsWith("please report this, with the error in the console.");
    }

    @Test
    void whatTheUserCancelsEndsTheMacroAndACommandOfTheMenuJustEnds() {
        Runnable cancelled = () -> {
            throw new CancellationException();
        };
        assertThat(said(cancelled)).isEqualTo("MEMTrack: Cancelled.");
        assertThatCode(() -> Commands.run(cancelled, true)).doesNotThrowAnyException();
    }

    /** What a command that fails prints, when it stops the macro as ImageJ expects. */
    private static String said(Runnable work) {
        PrintStream before = System.out;
        ByteArrayOutputStream printed = new ByteArrayOutputStream();
        System.setOut(new PrintStream(printed, true, StandardCharsets.UTF_8));
        try {
            assertThatThrownBy(() -> Commands.run(work))
                    .isInstanceOf(RuntimeException.class)
                    .hasMessage(Macro.MACRO_CANCELED);
        } finally {
            System.setOut(before);
        }
        return printed.toString(StandardCharsets.UTF_8).strip();
    }
}
