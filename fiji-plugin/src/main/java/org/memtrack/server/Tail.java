// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.nio.charset.StandardCharsets;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import java.util.function.Consumer;

/** Reads what a process prints, so that it never blocks, and keeps the last lines. */
final class Tail {
    private static final int LINES = 60;

    private final Deque<String> lines = new ArrayDeque<>();
    private final Thread reader;
    private boolean finished;

    /**
     * Starts reading in a thread of its own, until the stream ends.
     *
     * @param each told of every line, in that thread, until {@link #finish} has returned
     */
    Tail(String name, InputStream stream, Consumer<String> each) {
        reader = new Thread(() -> read(stream, each), name);
        reader.setDaemon(true);
        reader.start();
    }

    synchronized List<String> lines() {
        return List.copyOf(lines);
    }

    /**
     * Waits until the stream has ended, at most a second: a grandchild may hold it open, or who is told be slow. Of lines
     * after that nothing is told or kept.
     */
    void finish() {
        try {
            reader.join(1000);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        synchronized (this) {
            finished = true;
        }
    }

    private void read(InputStream stream, Consumer<String> each) {
        try (BufferedReader in = new BufferedReader(new InputStreamReader(stream, StandardCharsets.UTF_8))) {
            for (String line = in.readLine(); line != null; line = in.readLine()) {
                tell(line, each);
            }
        } catch (IOException e) {
            keep("(reading its output failed: " + e.getMessage() + ")");
        }
    }

    /** The lock is held meanwhile, so that nobody is told of a line while {@link #finish} returns. */
    private synchronized void tell(String line, Consumer<String> each) {
        if (!finished) {
            keep(line);
            each.accept(line);
        }
    }

    private synchronized void keep(String line) {
        if (lines.size() == LINES) {
            lines.removeFirst();
        }
        lines.addLast(line);
    }
}
