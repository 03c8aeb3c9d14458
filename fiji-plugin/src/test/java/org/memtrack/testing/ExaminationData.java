// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.testing;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.abort;

import java.nio.file.Files;
import java.nio.file.Path;

/** Real films and files, kept outside the repository in the folder that the variable MEMTRACK_DATA names. */
public final class ExaminationData {
    private ExaminationData() {}

    /** A file or folder of it; without the folder the test fails when CI=true and is skipped otherwise. */
    public static Path path(String first, String... more) {
        String folder = System.getenv("MEMTRACK_DATA");
        if (folder == null || folder.isEmpty()) {
            String message = "MEMTRACK_DATA names no folder of real films and files";
            assertThat(System.getenv("CI")).as(message).isNotEqualTo("true");
            return abort("Skipped: " + message);
        }
        Path path = Path.of(folder, first).resolve(String.join("/", more));
        assertThat(Files.exists(path)).as("%s exists", path).isTrue();
        return path;
    }
}
