// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import ij.IJ;
import java.nio.file.Path;
import java.util.Optional;
import java.util.concurrent.atomic.AtomicBoolean;
import org.memtrack.detection.DetectorException;

/**
 * The TrackMate that this ImageJ has, if any; safe to call without one.
 *
 * <p>The rest of the plug-in meets TrackMate only here.
 */
public final class TrackMateInstallation {
    private static final String IN_ANY_VERSION = "fiji.plugin.trackmate.TrackMate";
    /** What version 8 brought and modules of ours are made of. */
    private static final String SINCE_VERSION_8 = "fiji.plugin.trackmate.TrackMateFactoryBase";

    private static final AtomicBoolean TOLD = new AtomicBoolean();

    private TrackMateInstallation() {}

    /** Why MEMTrack cannot work with TrackMate here, in one sentence; empty when it can. */
    public static Optional<String> problem() {
        return problem(TrackMateInstallation.class.getClassLoader());
    }

    static Optional<String> problem(ClassLoader loader) {
        if (!has(IN_ANY_VERSION, loader)) {
            return Optional.of(
                    "TrackMate is not installed, so MEMTrack's detector and tracker cannot be used inside it; all"
                            + " else works: for TrackMate, use Fiji, or update it with Help > Update.");
        }
        if (!has(SINCE_VERSION_8, loader)) {
            return Optional.of(
                    "This TrackMate is older than 8.0.0, so MEMTrack's detector and tracker cannot be used inside"
                            + " it; all else works: update Fiji with Help > Update.");
        }
        return Optional.empty();
    }

    /**
     * Opens a TrackMate file with its film in TrackMate's own window; needs a screen.
     *
     * @throws DetectorException when there is no TrackMate to open it with
     */
    public static void open(Path file) {
        problem().ifPresent(sentence -> {
            throw new DetectorException(sentence);
        });
        TrackMateWindow.open(file);
    }

    /** Writes the problem, if there is one, to ImageJ's log, the first time only. */
    static void tellProblemOnce() {
        if (TOLD.compareAndSet(false, true)) {
            problem().ifPresent(sentence -> IJ.log("MEMTrack: " + sentence));
        }
    }

    private static boolean has(String type, ClassLoader loader) {
        try {
            Class.forName(type, false, loader);
            return true;
        } catch (ClassNotFoundException | LinkageError e) {
            return false;
        }
    }
}
