// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import java.awt.GraphicsEnvironment;
import java.lang.StackWalker.StackFrame;
import java.util.List;
import java.util.Set;

/**
 * Whether this process has nothing to do but the macro that called: it was started for it from a command line, without a
 * screen. ImageJ ends such a process with 0 even when the macro failed, and the job's script would take that for success.
 */
final class BatchProcess {
    /** What runs the macro of a command line, in ImageJ and in Fiji. */
    private static final Set<String> COMMAND_LINES = Set.of(
            "ij.ImageJ", "net.imagej.legacy.LegacyCommandline$Macro", "net.imagej.legacy.LegacyCommandline$Batch");

    private BatchProcess() {}

    /** Called in the thread of the command. False where a host, or another macro, called the macro and may go on. */
    static boolean runsThisMacroOnly() {
        if (!GraphicsEnvironment.isHeadless()) {
            return false;
        }
        List<StackFrame> callers = StackWalker.getInstance().walk(frames -> frames.toList());
        long macros = callers.stream()
                .filter(frame -> frame.getClassName().equals("ij.plugin.Macro_Runner")
                        && frame.getMethodName().equals("runMacro"))
                .count();
        return macros == 1 && callers.stream().anyMatch(frame -> COMMAND_LINES.contains(frame.getClassName()));
    }
}
