// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import org.memtrack.client.Progress;

/** Cancels a program while it is at work, as the user may with Escape. */
final class CancellingProgram {
    /** Takes the program's command, then the file whose being there tells that it works. */
    public static void main(String[] command) throws Exception {
        Path atWork = Path.of(command[command.length - 1]);
        Progress cancelled = new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {}

            @Override
            public boolean cancelled() {
                return Files.exists(atWork);
            }
        };
        try {
            WatchedProcess.run(new ProcessBuilder(command), cancelled, line -> {}, Duration.ofMinutes(1));
        } catch (CancellationException e) {
            System.out.println("Cancelled");
        }
    }
}
