// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.ImagePlus;
import ij.io.FileInfo;
import java.io.File;
import java.nio.file.Path;
import org.memtrack.macro.GivenPath;

/** The folder for results that the dialog begins with: one beside each film, until the user chooses one of their own. */
final class OfferedFolder {
    private OfferedFolder() {}

    /**
     * The folder to offer for a film; empty when there is none to offer.
     *
     * @param own the folder that the user chose for an earlier film; empty when they never chose one
     */
    static String of(ImagePlus film, String own) {
        return own.isEmpty() ? beside(film) : own;
    }

    /**
     * The folder to remember as the user's own; empty when what they accepted is what is offered beside this film, so that
     * the next film gets one beside itself.
     *
     * @param accepted a path
     */
    static String own(ImagePlus film, String accepted) {
        String beside = beside(film);
        // As paths, since the dialog adds a separator at the end.
        return !beside.isEmpty() && GivenPath.of(accepted).equals(Path.of(beside)) ? "" : accepted;
    }

    private static String beside(ImagePlus film) {
        FileInfo info = film.getOriginalFileInfo();
        File folder = new File(info == null || info.directory == null ? "" : info.directory);
        return folder.isDirectory() ? new File(folder, "memtrack").getAbsolutePath() : "";
    }
}
