// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.plugin.frame.Recorder;
import java.util.Map;

/** The line of a macro that ImageJ's recorder, if it is open, writes for a command. */
final class RecordedLine {
    private RecordedLine() {}

    /**
     * Writes the line of the command that runs in the calling thread.
     *
     * <p>At once: the recorder would keep the options until the command has ended, and another one that is run meanwhile
     * would take their place. At the end ImageJ finds nothing left to write.
     */
    static void write(Map<String, String> options) {
        if (Recorder.record) {
            options.forEach((key, value) -> Recorder.recordOption(key, value.replace('\\', '/')));
            Recorder.saveCommand();
        }
    }
}
