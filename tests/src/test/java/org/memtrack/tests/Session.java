// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import java.awt.event.KeyEvent;
import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.util.List;

/** One headless ImageJ for all tests, so that they share a server as a user's runs do; keeps what it printed. */
final class Session {
    private static final MacroSession IMAGEJ = start();
    private static volatile ByteArrayOutputStream printed = new ByteArrayOutputStream();

    private Session() {}

    /**
     * What came of a macro.
     *
     * @param result "[aborted]" when a command failed
     * @param log what ImageJ printed
     */
    record Outcome(String result, String log) {
        boolean aborted() {
            return result.equals("[aborted]");
        }

        /** The one sentence of a failure. */
        String sentence() {
            List<String> sentences =
                    log.lines().filter(line -> line.startsWith("MEMTrack: ")).toList();
            return sentences.size() == 1 ? sentences.get(0) : "not one sentence but " + sentences;
        }
    }

    /** Forgets what the last macro has printed; to be called before one is run in another thread, whose log is waited for. */
    static void forget() {
        printed = new ByteArrayOutputStream();
    }

    /** Runs a macro; images that were open are closed before. */
    static Outcome run(String macro, String argument) throws Exception {
        PrintStream console = System.out;
        forget();
        System.setOut(new PrintStream(printed, true, StandardCharsets.UTF_8));
        try {
            String result = IMAGEJ.run("close(\"*\");\n" + macro, argument);
            return new Outcome(result, log());
        } finally {
            System.setOut(console);
            console.print(log());
        }
    }

    /** What the macro at work, or the last one, has printed. */
    static String log() {
        return printed.toString(StandardCharsets.UTF_8);
    }

    /** Presses the Escape key. */
    static void escape() throws Exception {
        IMAGEJ.classes().loadClass("ij.IJ").getMethod("setKeyDown", int.class).invoke(null, KeyEvent.VK_ESCAPE);
    }

    /** The server process of this session's ImageJ. */
    static ProcessHandle server() {
        return ProcessHandle.current()
                .descendants()
                .filter(ProcessHandle::isAlive)
                .filter(process -> process.info().commandLine().orElse("").contains("memtrack serve"))
                .findFirst()
                .orElseThrow(() -> new AssertionError("No server runs"));
    }

    private static MacroSession start() {
        try {
            return new MacroSession();
        } catch (Exception e) {
            throw new IllegalStateException(e);
        }
    }
}
