// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.TimeoutException;
import org.memtrack.client.Progress;

/** Quits, as the user may quit ImageJ, while a program is at work. */
final class QuittingProgram {
    /** Takes the program's command, then the file whose being there tells that it works. */
    public static void main(String[] command) throws InterruptedException {
        Path atWork = Path.of(command[command.length - 1]);
        new Thread(() -> work(command)).start();
        while (!Files.exists(atWork)) {
            Thread.sleep(10);
        }
        System.exit(0);
    }

    private static void work(String[] command) {
        try {
            WatchedProcess.run(new ProcessBuilder(command), Progress.NONE, line -> {}, Duration.ofMinutes(1));
        } catch (IOException | TimeoutException e) {
            throw new IllegalStateException(e);
        }
    }
}
