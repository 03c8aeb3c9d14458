// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

/** One Python could not start the server; another one may. The message is a clause without a full stop. */
final class StartException extends Exception {
    private static final long serialVersionUID = 1;

    StartException(String message, Throwable cause) {
        super(message, cause);
    }
}
