// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.nio.file.FileVisitResult;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.SimpleFileVisitor;
import java.nio.file.attribute.BasicFileAttributes;

/** Deletes folders of ours. */
final class Folders {
    private Folders() {}

    /** Deletes a folder and all in it, not following links; without effect when it is not there. */
    private static void delete(Path folder) throws IOException {
        if (!Files.exists(folder)) {
            return;
        }
        Files.walkFileTree(folder, new SimpleFileVisitor<>() {
            @Override
            public FileVisitResult visitFile(Path file, BasicFileAttributes attributes) throws IOException {
                Files.delete(file);
                return FileVisitResult.CONTINUE;
            }

            @Override
            public FileVisitResult postVisitDirectory(Path visited, IOException failure) throws IOException {
                Files.delete(visited);
                return FileVisitResult.CONTINUE;
            }
        });
    }

    /** Deletes a folder and all in it; what cannot be deleted stays, with a line in the log. */
    static void tryDelete(Path folder) {
        try {
            delete(folder);
        } catch (IOException e) {
            System.getLogger("org.memtrack").log(System.Logger.Level.INFO, "Not deleted yet: " + folder, e);
        }
    }
}
