// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.nio.file.Path;
import java.util.concurrent.CancellationException;
import org.memtrack.client.Progress;

/** How the folder of an environment comes about, before the server is installed into it. */
@FunctionalInterface
interface EnvironmentStart {
    /**
     * Makes the folder, with a Python and its pip in it.
     *
     * @param folder holds nothing yet but the server's wheel; what is made of it on a failure is the caller's to delete
     * @throws CancellationException when progress was cancelled
     */
    void make(Path folder, Progress progress) throws IOException;
}
