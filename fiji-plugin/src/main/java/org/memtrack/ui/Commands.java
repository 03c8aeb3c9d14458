// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.IJ;
import ij.Macro;
import java.awt.GraphicsEnvironment;
import java.util.concurrent.CancellationException;
import org.memtrack.detection.DetectorException;

/** How every command ends: a failure is one sentence to the user and stops the macro it was called from. */
final class Commands {
    private static final System.Logger LOG = System.getLogger("org.memtrack");

    private Commands() {}

    /** Runs a command's work in the calling thread, and ends it as ImageJ expects. */
    static void run(Runnable work) {
        try {
            work.run();
        } catch (CancellationException e) {
            IJ.showStatus("MEMTrack: cancelled");
            stopMacro();
        } catch (DetectorException e) {
            LOG.log(System.Logger.Level.DEBUG, "MEMTrack failed", e);
            tell(e.getMessage());
            stopMacro();
        } catch (RuntimeException e) {
            // ImageJ would show the stack trace and go on with the macro.
            LOG.log(System.Logger.Level.ERROR, "MEMTrack failed unexpectedly", e);
            tell("MEMTrack failed unexpectedly (%s): please report this, with the error in the console.".formatted(e));
            stopMacro();
        } finally {
            if (!GraphicsEnvironment.isHeadless()) {
                IJ.showProgress(1);
            }
        }
    }

    private static void tell(String sentence) {
        if (GraphicsEnvironment.isHeadless()) {
            IJ.log("MEMTrack: " + sentence);
        } else {
            IJ.error("MEMTrack", sentence);
        }
    }

    /** Ends a macro, and lets IJ.run throw in a program that called it; without effect on a command of the menu. */
    private static void stopMacro() {
        Macro.abort();
        throw new RuntimeException(Macro.MACRO_CANCELED);
    }
}
