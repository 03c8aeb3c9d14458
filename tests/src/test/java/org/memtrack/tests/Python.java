// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

/** The Python with the model server that the tests are run with. */
final class Python {
    private Python() {}

    static String path() {
        String path = System.getenv("MEMTRACK_PYTHON");
        if (path == null) {
            throw new AssertionError(
                    "Set MEMTRACK_PYTHON to a Python that has the model server, or run the tests with the"
                            + " command of the README");
        }
        return path;
    }
}
