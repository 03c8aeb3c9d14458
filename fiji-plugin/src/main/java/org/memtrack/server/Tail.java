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

    /**
     * Starts reading in a thread of its own, until the stream ends.
     *
     * @param each told of every line, in that thread
     */
    Tail(String name, InputStream stream, Consumer<String> each) {
        reader = new Thread(() -> read(stream, each), name);
        reader.setDaemon(true);
        reader.start();
    }

    synchronized List<String> lines() {
        return List.copyOf(lines);
    }

    /** Waits until the stream has ended, at most a second: a grandchild may hold it open. */
    void finish() {
        try {
            reader.join(1000);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private void read(InputStream stream, Consumer<String> each) {
        try (BufferedReader in = new BufferedReader(new InputStreamReader(stream, StandardCharsets.UTF_8))) {
            for (String line = in.readLine(); line != null; line = in.readLine()) {
                keep(line);
                each.accept(line);
            }
        } catch (IOException e) {
            keep("(reading its output failed: " + e.getMessage() + ")");
        }
    }

    private synchronized void keep(String line) {
        if (lines.size() == LINES) {
            lines.removeFirst();
        }
        lines.addLast(line);
    }
}
