// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.IJ;
import ij.Macro;
import ij.macro.Interpreter;
import ij.plugin.frame.Recorder;
import java.awt.GraphicsEnvironment;
import java.util.concurrent.CancellationException;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;

/** How every command ends: a failure is one sentence to the user and stops the macro it was called from. */
final class Commands {
    private static final System.Logger LOG = System.getLogger("org.memtrack");

    private Commands() {}

    /** Runs a command's work in the calling thread, and ends it as ImageJ expects. */
    static void run(Runnable work) {
        // A script is told by its options, or by ImageJ's own note that it runs a command for one.
        run(work, !GraphicsEnvironment.isHeadless() && !IJ.isMacro() && Macro.getOptions() == null);
    }

    /**
     * Likewise; a command of the menu that is cancelled just ends.
     *
     * @param fromTheMenu whether the user has called, and no macro or script
     */
    static void run(Runnable work, boolean fromTheMenu) {
        String recorded = Recorder.getCommand();
        try {
            work.run();
        } catch (CancellationException e) {
            IJ.showStatus("MEMTrack: cancelled");
            if (fromTheMenu) {
                // There is no macro to stop, and what that takes would make ImageJ wipe the status.
                forget(recorded);
                return;
            }
            if (GraphicsEnvironment.isHeadless()) {
                IJ.log("MEMTrack: Cancelled.");
            }
            stopMacro("Cancelled.");
        } catch (DetectorException e) {
            LOG.log(System.Logger.Level.DEBUG, "MEMTrack failed", e);
            tell(e.getMessage());
            stopMacro(e.getMessage());
        } catch (RuntimeException | Error e) {
            // ImageJ would show the stack trace and go on with the macro.
            LOG.log(System.Logger.Level.ERROR, "MEMTrack failed unexpectedly", e);
            String sentence = e instanceof OutOfMemoryError
                    ? "The memory of ImageJ (%d MB) is full: close other images, or give it more in Edit > Options > Memory & Threads, and run again."
                            .formatted(Runtime.getRuntime().maxMemory() >> 20)
                    : "MEMTrack failed unexpectedly (%s): please report this, with the error in the console."
                            .formatted(e);
            tell(sentence);
            stopMacro(sentence);
        } finally {
            if (!GraphicsEnvironment.isHeadless()) {
                IJ.showProgress(1);
            }
        }
    }

    /** In lines that fit into a dialog. */
    static String wrapped(String sentence) {
        return sentence.replaceAll("(.{1,80})(\\s+|$)", "$1\n").strip();
    }

    /** A command that was cancelled is not recorded, unless its line is there already; another one's is left alone. */
    private static void forget(@Nullable String command) {
        if (command != null && command.equals(Recorder.getCommand())) {
            Recorder.disableCommandRecording();
        }
    }

    private static void tell(String sentence) {
        if (GraphicsEnvironment.isHeadless()) {
            IJ.log("MEMTrack: " + sentence);
        } else {
            IJ.showMessage("MEMTrack", wrapped(sentence));
        }
    }

    /**
     * Ends the macro that called, with the result "[aborted]"; a command of the menu just ends.
     *
     * <p>IJ.error would show a second dialog, about the line of the macro, and without a screen Macro.abort alone lets the
     * macro go on. A process that has only this macro to run ends with 1.
     */
    private static void stopMacro(String sentence) {
        if (BatchProcess.runsThisMacroOnly()) {
            System.exit(1);
        }
        Interpreter macro = Interpreter.getInstance();
        if (macro != null) {
            macro.setIgnoreErrors(true);
            IJ.error(sentence);
        }
        Macro.abort();
        throw new RuntimeException(Macro.MACRO_CANCELED);
    }
}
