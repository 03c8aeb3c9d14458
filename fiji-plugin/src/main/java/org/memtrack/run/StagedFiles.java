// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayDeque;
import java.util.Comparator;
import java.util.Deque;
import java.util.List;
import java.util.UUID;
import java.util.stream.Stream;

/** Files of one folder that are written aside, and take their places when all of them are there. */
final class StagedFiles implements AutoCloseable {
    private final Path aside;
    private boolean kept;

    private record Move(Path from, Path to) {}

    StagedFiles(Path folder) throws IOException {
        aside = Files.createDirectory(folder.resolve(".memtrack-" + UUID.randomUUID() + ".part"));
    }

    /** Where to write what will be the target. */
    Path of(Path target) {
        return aside.resolve(target.getFileName());
    }

    /**
     * Moves files to their places, in this order, and does away with those that lay there, also where no new one was written.
     *
     * @throws IOException when one cannot be moved, for example as another program has the older one open; the older ones
     *     are then in their places again, any that cannot go back in the folder "earlier" aside, and the new ones aside
     */
    void moveTo(List<Path> targets) throws IOException {
        Path earlier = Files.createDirectory(aside.resolve("earlier"));
        Deque<Move> done = new ArrayDeque<>();
        try {
            for (Path target : targets) {
                if (Files.exists(target)) {
                    move(target, earlier.resolve(target.getFileName()), done);
                }
            }
            for (Path target : targets) {
                if (Files.exists(of(target))) {
                    move(of(target), target, done);
                }
            }
        } catch (IOException e) {
            undo(done, earlier, e);
            throw e;
        }
    }

    /** Leaves what was written where it is when this is closed; gives the folder. */
    Path keep() {
        kept = true;
        return aside;
    }

    /** Deletes what is left aside; what cannot be deleted stays, with a line in the log, since all that counts is done. */
    @Override
    public void close() {
        if (kept) {
            return;
        }
        try {
            for (Path left : left()) {
                Files.delete(left);
            }
        } catch (IOException e) {
            System.getLogger("org.memtrack").log(System.Logger.Level.INFO, "Not deleted: " + aside, e);
        }
    }

    /** Innermost first. */
    private List<Path> left() throws IOException {
        try (Stream<Path> all = Files.walk(aside)) {
            return all.sorted(Comparator.reverseOrder()).toList();
        }
    }

    private static void move(Path from, Path to, Deque<Move> done) throws IOException {
        Files.move(from, to);
        done.push(new Move(from, to));
    }

    private static void undo(Deque<Move> done, Path earlier, IOException failure) {
        for (Move move : done) {
            try {
                Files.move(move.to, move.from);
            } catch (IOException e) {
                failure.addSuppressed(e);
            }
        }
        try {
            Files.delete(earlier);
        } catch (IOException e) {
            failure.addSuppressed(e);
        }
    }
}
