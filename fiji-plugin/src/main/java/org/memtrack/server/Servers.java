// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.util.concurrent.CancellationException;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;

/** Where detection servers are had from; one server of our own is shared by all of an ImageJ session. */
public final class Servers {
    private Servers() {}

    /**
     * A server that is ready: the one at the address given, or the running one of our own, or a new one started with the
     * interpreter given, or that of MEMTRACK_PYTHON, or the environment made by our installer, or python3 on the path.
     *
     * @param settings where to look
     * @param progress told what is being started, asked whether to go on
     * @throws DetectorException when there is none, or it does not answer; the message says what to do
     * @throws CancellationException when progress was cancelled
     */
    public static ServerConnection acquire(ServerSettings settings, Progress progress) {
        throw new UnsupportedOperationException("To come");
    }
}
