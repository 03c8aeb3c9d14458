// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.memtrack.client.DetectionClient;
import org.memtrack.client.Progress;
import org.memtrack.client.ServerInfo;
import org.memtrack.detection.DetectorException;

/** Where detection servers are had from; one server of our own is shared by all of an ImageJ session. */
public final class Servers {
    private static final Pattern ADDRESS = Pattern.compile("(\\[[0-9a-fA-F:]+\\]|[^:\\s]+):(\\d{1,5})");
    private static final ManagedServer MANAGED = new ManagedServer(Duration.ofMinutes(10), ServerWheel::find);

    static {
        Runtime.getRuntime().addShutdownHook(new Thread(MANAGED::close, "memtrack-server-end"));
    }

    private Servers() {}

    /**
     * A server that is ready: the one at the address given, or the running one of our own, or a new one started with the
     * interpreter given, or that of MEMTRACK_PYTHON, or the environment made by our installer, or a Python of this machine.
     * A running one of another interpreter than the one asked for is not used.
     *
     * @param settings where to look
     * @param progress told what is being started, asked whether to go on
     * @throws DetectorException when there is none, or it does not answer; the message says what to do
     * @throws CancellationException when progress was cancelled
     */
    public static ServerConnection acquire(ServerSettings settings, Progress progress) {
        progress.report("Starting the server", 0, OptionalDouble.empty(), "");
        return settings.address() == null
                ? MANAGED.acquire(
                        Interpreters.candidates(settings.python(), System.getenv(), DataFolder.path()), progress)
                : at(settings.address());
    }

    /**
     * Takes the server of our own, if one runs, out of use: the next {@link #acquire} starts a new one, and the old one ends
     * when the runs that it works for have ended.
     */
    static void retire() {
        MANAGED.retire();
    }

    private static ServerConnection at(String address) {
        Matcher parts = ADDRESS.matcher(address);
        if (!parts.matches() || Integer.parseInt(parts.group(2)) > 65535) {
            throw new DetectorException("\"%s\" is no address of a server: give host:port, for example 127.0.0.1:50051."
                    .formatted(address));
        }
        String token = System.getenv().getOrDefault("MEMTRACK_TOKEN", "");
        DetectionClient client = DetectionClient.connect(parts.group(1), Integer.parseInt(parts.group(2)), token);
        try {
            ServerInfo info = client.info(false);
            return new ServerConnection(client, info, address, List.of(), Optional::empty, client::close);
        } catch (DetectorException e) {
            client.close();
            throw new DetectorException(
                    "No server of MEMTrack can be used at %s: %s".formatted(address, e.getMessage()), e);
        }
    }
}
