// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.ScheduledFuture;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.ReentrantLock;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.DetectionClient;
import org.memtrack.client.Progress;
import org.memtrack.client.ServerInfo;
import org.memtrack.detection.DetectorException;

/** The one server of our own in an ImageJ session: started when first wanted, shared, ended when idle or at the end. */
final class ManagedServer {
    private final Duration idleLimit;
    private final Supplier<Optional<ServerWheel>> carried;
    private final ReentrantLock lock = new ReentrantLock();
    private final ScheduledExecutorService timer = Executors.newSingleThreadScheduledExecutor(task -> {
        Thread thread = new Thread(task, "memtrack-server-idle");
        thread.setDaemon(true);
        return thread;
    });
    /** Out of use, but still at work for those who had them. */
    private final List<Running> retired = new ArrayList<>();

    private @Nullable Running running;
    private @Nullable ScheduledFuture<?> ending;
    private volatile boolean closing;

    private record Running(
            LocalServer server, DetectionClient client, ServerInfo info, List<String> warnings, List<Object> users) {}

    /**
     * @param idleLimit after which a server that nobody uses is ended
     * @param carried the wheel in the plug-in's jar, if it has one: what an environment of ours should have been made with
     */
    ManagedServer(Duration idleLimit, Supplier<Optional<ServerWheel>> carried) {
        this.idleLimit = idleLimit;
        this.carried = carried;
    }

    /** A connection to the running server if it is one of the candidates, or to a new one of the best that starts. */
    ServerConnection acquire(List<Interpreter> candidates, Progress progress) {
        lock(progress);
        try {
            Running current = running;
            boolean wanted = current != null && isOneOf(candidates, current.server.interpreter());
            if (current != null && !wanted && inUse(current)) {
                throw new DetectorException(
                        "Another run is using the server of %s: wait for it, or use the same Python."
                                .formatted(current.server.interpreter().describe()));
            }
            // One in use may be too busy to answer, and its run would fail with it.
            if (current == null || !wanted || !inUse(current) && !answers(current)) {
                current = start(candidates, progress);
            }
            return use(current);
        } finally {
            lock.unlock();
        }
    }

    /** Ends the server for good, also one that is starting. */
    void close() {
        closing = true;
        end();
    }

    /** Takes the server out of use: nobody else gets it, and it ends when its last user, if it has any, gives it back. */
    void retire() {
        lock.lock();
        try {
            if (running != null && inUse(running)) {
                retired.add(running);
                running = null;
            } else {
                endRunning();
            }
        } finally {
            lock.unlock();
        }
    }

    /** Ends the server and those that were retired, also under their users. */
    void end() {
        lock.lock();
        try {
            endRunning();
            retired.forEach(ManagedServer::end);
            retired.clear();
        } finally {
            lock.unlock();
        }
    }

    private void endRunning() {
        if (running != null) {
            end(running);
            running = null;
        }
    }

    private static void end(Running server) {
        server.client.close();
        server.server.end();
    }

    private Running start(List<Interpreter> candidates, Progress progress) {
        // It has died, or nobody uses it.
        endRunning();
        List<String> reasons = new ArrayList<>();
        for (Interpreter candidate : candidates) {
            try {
                LocalServer server = LocalServer.start(candidate, untilClosing(progress));
                running = connect(server);
                return running;
            } catch (StartException e) {
                reasons.add(e.getMessage());
            }
        }
        throw new DetectorException(
                reasons.isEmpty()
                        ? noPython(CarriedPython.find())
                        : "No server could be started, since %s: run Plugins > Tracking > MEMTrack > MEMTrack Install Python"
                                        .formatted(String.join("; ", reasons))
                                + " Environment, or name a Python that has MEMTrack.");
    }

    /** Cancelled by the end of ImageJ, too. */
    private Progress untilClosing(Progress progress) {
        return new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
                progress.report(stage, fraction, secondsLeft, message);
            }

            @Override
            public boolean cancelled() {
                return closing || progress.cancelled();
            }
        };
    }

    /** What to do when there is no Python to start a server with. */
    static String noPython(Optional<CarriedPython> carried) {
        String command = "run Plugins > Tracking > MEMTrack > MEMTrack Install Python Environment.";
        return carried.isPresent()
                ? "The server's Python environment is not installed yet: " + command
                : "No Python was found: %s, then %s".formatted(CarriedPython.advice(), command);
    }

    private Running connect(LocalServer server) {
        DetectionClient client = server.connect();
        try {
            return new Running(server, client, client.info(false), warnings(server.interpreter()), new ArrayList<>());
        } catch (RuntimeException e) {
            client.close();
            server.end();
            throw e;
        }
    }

    private List<String> warnings(Interpreter interpreter) {
        PythonEnvironment environment = interpreter.environment();
        return environment == null
                ? List.of()
                : carried.get().flatMap(environment::warning).stream().toList();
    }

    private static boolean isOneOf(List<Interpreter> candidates, Interpreter interpreter) {
        return candidates.stream().anyMatch(candidate -> candidate.command().equals(interpreter.command()));
    }

    private static boolean inUse(Running current) {
        return current.server.alive() && !current.users.isEmpty();
    }

    private static boolean answers(Running current) {
        if (!current.server.alive()) {
            return false;
        }
        try {
            current.client.info(false);
            return true;
        } catch (DetectorException e) {
            return false;
        }
    }

    private ServerConnection use(Running current) {
        Object user = new Object();
        current.users.add(user);
        if (ending != null) {
            ending.cancel(false);
            ending = null;
        }
        return new ServerConnection(
                current.client,
                current.info,
                current.server.interpreter().describe(),
                current.warnings,
                current.server::death,
                () -> release(current, user));
    }

    private void release(Running used, Object user) {
        lock.lock();
        try {
            if (!used.users.remove(user) || !used.users.isEmpty()) {
                return;
            }
            if (used == running) {
                ending = timer.schedule(() -> endIfIdle(used), idleLimit.toMillis(), TimeUnit.MILLISECONDS);
            } else if (retired.remove(used)) {
                end(used);
            }
        } finally {
            lock.unlock();
        }
    }

    private void endIfIdle(Running idle) {
        lock.lock();
        try {
            if (idle == running && idle.users.isEmpty()) {
                endRunning();
            }
        } finally {
            lock.unlock();
        }
    }

    private void lock(Progress progress) {
        try {
            while (!lock.tryLock(100, TimeUnit.MILLISECONDS)) {
                progress.throwIfCancelled();
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new CancellationException("Interrupted.");
        }
    }
}
