// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.io.IOException;
import java.nio.file.DirectoryStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.ArrayList;
import java.util.List;
import java.util.UUID;

/** Files of one folder that are written aside, and take their places when all of them are there. */
final class StagedFiles implements AutoCloseable {
    private final Path aside;

    StagedFiles(Path folder) throws IOException {
        aside = Files.createDirectory(folder.resolve(".memtrack-" + UUID.randomUUID() + ".part"));
    }

    /** Where to write what will be the target. */
    Path of(Path target) {
        return aside.resolve(target.getFileName());
    }

    /**
     * Moves files to their places, in this order.
     *
     * @throws IOException when one cannot be moved, for example as another program has the older one open; those moved so
     *     far are removed, so that no file of this run lies beside those of another
     */
    void moveTo(List<Path> targets) throws IOException {
        List<Path> moved = new ArrayList<>();
        try {
            for (Path target : targets) {
                Files.move(of(target), target, StandardCopyOption.REPLACE_EXISTING);
                moved.add(target);
            }
        } catch (IOException e) {
            for (Path target : moved) {
                Files.deleteIfExists(target);
            }
            throw e;
        }
    }

    @Override
    public void close() throws IOException {
        try (DirectoryStream<Path> left = Files.newDirectoryStream(aside)) {
            for (Path file : left) {
                Files.delete(file);
            }
        }
        Files.delete(aside);
    }
}
