// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.IJ;
import java.awt.GraphicsEnvironment;
import java.util.Locale;
import java.util.OptionalDouble;
import org.memtrack.client.Progress;

/** Progress in ImageJ's status bar, in the log when there is no screen; Escape cancels. */
final class StatusProgress implements Progress {
    private final boolean headless = GraphicsEnvironment.isHeadless();
    private String loggedStage = "";
    private int loggedTenth = -1;

    StatusProgress() {
        IJ.resetEscape();
    }

    @Override
    public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
        String line = line(stage, secondsLeft, message);
        if (headless) {
            int tenth = (int) (fraction * 10);
            if (!stage.equals(loggedStage) || tenth > loggedTenth) {
                loggedStage = stage;
                loggedTenth = tenth;
                IJ.log(String.format(Locale.ROOT, "%3.0f %% %s", fraction * 100, line));
            }
        } else {
            IJ.showProgress(fraction);
            IJ.showStatus("MEMTrack: " + line + " (Esc cancels)");
        }
    }

    @Override
    public boolean cancelled() {
        return IJ.escapePressed() || Thread.currentThread().isInterrupted();
    }

    private static String line(String stage, OptionalDouble secondsLeft, String message) {
        StringBuilder line = new StringBuilder(stage);
        if (!message.isEmpty()) {
            line.append(", ").append(message);
        }
        secondsLeft.ifPresent(
                seconds -> line.append(", ").append(duration(seconds)).append(" left"));
        return line.toString();
    }

    static String duration(double seconds) {
        long whole = Math.round(Math.ceil(seconds));
        return whole < 100 ? whole + " s" : "%d:%02d min".formatted(whole / 60, whole % 60);
    }
}
