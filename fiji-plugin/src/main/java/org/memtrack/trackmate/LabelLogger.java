// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Logger;
import java.awt.Color;
import javax.swing.JLabel;
import javax.swing.SwingUtilities;

/** Shows what a small run says in one label; callable from any thread. */
final class LabelLogger extends Logger {
    private static final int WIDTH = 220;

    private final JLabel label;

    LabelLogger(JLabel label) {
        this.label = label;
    }

    @Override
    public void log(String message, Color color) {
        if (!message.isBlank()) {
            SwingUtilities.invokeLater(() -> label.setText(Form.wrapped(escaped(message.trim()), WIDTH)));
        }
    }

    @Override
    public void log(String message) {
        log(message, Color.BLACK);
    }

    @Override
    public void error(String message) {
        log(message, Color.RED);
    }

    @Override
    public void setProgress(double fraction) {}

    @Override
    public void setStatus(String status) {
        log(status);
    }

    /** Text that is safe inside HTML. */
    static String escaped(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;");
    }
}
