// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.util.List;
import java.util.Optional;
import java.util.function.Supplier;
import org.memtrack.client.DetectionClient;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Progress;
import org.memtrack.client.ServerInfo;
import org.memtrack.detection.DetectorException;
import org.memtrack.video.Film;

/** A server that has answered, with a client to call it; to be closed after use. */
public final class ServerConnection implements AutoCloseable {
    private final DetectionClient client;
    private final ServerInfo info;
    private final String origin;
    private final List<String> warnings;
    private final Supplier<Optional<String>> death;
    private final Runnable release;

    /**
     * @param death how the server's process ended; empty while it runs or when it is not ours
     * @param release called by {@link #close}
     */
    ServerConnection(
            DetectionClient client,
            ServerInfo info,
            String origin,
            List<String> warnings,
            Supplier<Optional<String>> death,
            Runnable release) {
        this.client = client;
        this.info = info;
        this.origin = origin;
        this.warnings = List.copyOf(warnings);
        this.death = death;
        this.release = release;
    }

    public DetectionClient client() {
        return client;
    }

    /**
     * Detects in a film, as {@link DetectionClient#detect}; when a server of our own dies meanwhile, the error tells its
     * last words.
     */
    public DetectionResult detect(Film film, DetectionSettings settings, Progress progress) {
        try {
            return client.detect(film, settings, progress);
        } catch (DetectorException e) {
            throw death.get().map(how -> new DetectorException(how, e)).orElse(e);
        }
    }

    /** What the server said of itself when the connection was made. */
    public ServerInfo info() {
        return info;
    }

    /** Where the server comes from, for the user: an address or an interpreter. */
    public String origin() {
        return origin;
    }

    /** What the user should know of this server, one sentence each. */
    public List<String> warnings() {
        return warnings;
    }

    /** Gives the connection back; a server of our own goes on for the next run. */
    @Override
    public void close() {
        release.run();
    }
}
