// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.detection;

/** A failure the user can do something about; its message is one sentence: what failed, with what value, what to do next. */
public final class DetectorException extends RuntimeException {
    private static final long serialVersionUID = 1;

    public DetectorException(String message) {
        super(message);
    }

    public DetectorException(String message, Throwable cause) {
        super(message, cause);
    }
}
