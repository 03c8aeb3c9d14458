// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;
import org.memtrack.client.Progress;

/** Runs a program to its end, or ends it and its children when the user cancels or quits ImageJ. */
final class WatchedProcess {
    private static final Set<Process> RUNNING = ConcurrentHashMap.newKeySet();

    /** A parent that reaps its children does so within milliseconds; others never do. */
    private static final Duration REAPING_LIMIT = Duration.ofSeconds(1);

    private static final Duration ENDING_LIMIT = Duration.ofSeconds(5);

    static {
        Runtime.getRuntime()
                .addShutdownHook(new Thread(() -> RUNNING.forEach(WatchedProcess::kill), "memtrack-programs-end"));
    }

    private WatchedProcess() {}

    /**
     * How a program ended.
     *
     * @param exitCode 0 for success
     * @param lines the last lines it printed, of both streams
     */
    record End(int exitCode, List<String> lines) {}

    /**
     * Runs a program.
     *
     * @param each told every line, in a thread of its own, and nothing more when this has returned
     * @param limit after which the program is ended
     * @throws IOException when it cannot be started
     * @throws TimeoutException when it did not end in time; the message is a clause that says so
     * @throws CancellationException when progress was cancelled; the program and its children have ended
     */
    static End run(ProcessBuilder builder, Progress progress, Consumer<String> each, Duration limit)
            throws IOException, TimeoutException {
        Process process = builder.redirectErrorStream(true).start();
        process.getOutputStream().close();
        Tail output = new Tail("memtrack-output", process.getInputStream(), each);
        long end = System.nanoTime() + limit.toNanos();
        try {
            RUNNING.add(process);
            while (!process.waitFor(100, TimeUnit.MILLISECONDS)) {
                progress.throwIfCancelled();
                if (System.nanoTime() > end) {
                    throw new TimeoutException("did not end within "
                            + (limit.toMinutes() > 0 ? limit.toMinutes() + " min" : limit.toSeconds() + " s"));
                }
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new CancellationException("Interrupted.");
        } finally {
            kill(process);
            RUNNING.remove(process);
            output.finish();
        }
        return new End(process.exitValue(), output.lines());
    }

    /** Ends it and its children; on Windows the python of a venv is a launcher, and its child the real one. */
    private static void kill(Process process) {
        List<ProcessHandle> family = new ArrayList<>(process.descendants().toList());
        killChildren(process.toHandle());
        // What it has started meanwhile.
        process.descendants().forEach(late -> {
            late.destroyForcibly();
            family.add(late);
        });
        process.destroyForcibly();
        family.add(process.toHandle());
        // On Windows files can be deleted only when their process has ended.
        if (!await(family, ENDING_LIMIT)) {
            System.getLogger("org.memtrack").log(System.Logger.Level.INFO, "Still running: " + family);
        }
    }

    /**
     * Ends the children and theirs before their parent, whose it is to reap them: left to the first process of a container
     * that reaps nobody, they would stay as zombies, and never be told to have ended.
     */
    private static void killChildren(ProcessHandle parent) {
        List<ProcessHandle> children = parent.children().toList();
        children.forEach(WatchedProcess::killChildren);
        children.forEach(ProcessHandle::destroyForcibly);
        await(children, REAPING_LIMIT);
    }

    /** False when some have not ended in time. */
    private static boolean await(List<ProcessHandle> processes, Duration limit) {
        try {
            CompletableFuture.allOf(
                            processes.stream().map(ProcessHandle::onExit).toArray(CompletableFuture[]::new))
                    .get(limit.toMillis(), TimeUnit.MILLISECONDS);
            return true;
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return true;
        } catch (ExecutionException | TimeoutException e) {
            return false;
        }
    }
}
