// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import java.awt.Color;
import java.io.PrintWriter;
import java.io.Writer;

public abstract class Logger extends PrintWriter {
    public static final Logger VOID_LOGGER = signature();

    public Logger() {
        super(Writer.nullWriter());
    }

    public abstract void log(String message, Color color);

    public abstract void error(String message);

    public void log(String message) {
        throw new UnsupportedOperationException();
    }

    public abstract void setProgress(double fraction);

    public abstract void setStatus(String status);

    private static Logger signature() {
        throw new UnsupportedOperationException();
    }
}
