// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.nio.file.Path;

/** The folder of real films, MEMTRACK_DATA: tests that need it fail without it when CI=true, and are skipped elsewhere. */
final class Examination {
    private Examination() {}

    static Path folder() {
        String folder = System.getenv("MEMTRACK_DATA");
        if (folder == null && "true".equals(System.getenv("CI"))) {
            throw new AssertionError("MEMTRACK_DATA is not set");
        }
        assumeTrue(folder != null, "Skipped: MEMTRACK_DATA is not set, the real films are not here");
        return Path.of(folder);
    }
}
