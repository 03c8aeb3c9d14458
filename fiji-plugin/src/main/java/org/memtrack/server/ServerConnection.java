// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import org.memtrack.client.DetectionClient;
import org.memtrack.client.ServerInfo;

/** A server that has answered, with a client to call it; to be closed after use. */
public final class ServerConnection implements AutoCloseable {
    private final DetectionClient client;
    private final ServerInfo info;
    private final String origin;
    private final Runnable release;

    ServerConnection(DetectionClient client, ServerInfo info, String origin, Runnable release) {
        this.client = client;
        this.info = info;
        this.origin = origin;
        this.release = release;
    }

    public DetectionClient client() {
        return client;
    }

    /** What the server said of itself when the connection was made. */
    public ServerInfo info() {
        return info;
    }

    /** Where the server comes from, for the user: an address or an interpreter. */
    public String origin() {
        return origin;
    }

    /** Gives the connection back; a server of our own goes on for the next run. */
    @Override
    public void close() {
        release.run();
    }
}
