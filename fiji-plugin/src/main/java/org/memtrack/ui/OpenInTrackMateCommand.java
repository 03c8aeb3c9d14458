// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.Macro;
import ij.io.OpenDialog;
import ij.plugin.PlugIn;
import java.awt.GraphicsEnvironment;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Optional;
import java.util.concurrent.CancellationException;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.GivenPath;
import org.memtrack.trackmate.TrackMateInstallation;

/** The command "MEMTrack Open in TrackMate": opens the tracks of an earlier run over their film, in TrackMate's window. */
public final class OpenInTrackMateCommand implements PlugIn {
    /** Its first word is the key under which ImageJ's dialog records the file. */
    static final String QUESTION = "File of tracks (.xml)";

    @Override
    public void run(String argument) {
        Commands.run(OpenInTrackMateCommand::open);
    }

    private static void open() {
        Optional<Path> given = Optional.ofNullable(Macro.getOptions()).map(OpenInTrackMateCommand::given);
        TrackMateInstallation.problem().ifPresent(sentence -> {
            throw new DetectorException(sentence);
        });
        if (GraphicsEnvironment.isHeadless()) {
            throw new DetectorException("TrackMate's window needs a screen; without one, read the .csv of the run.");
        }
        TrackMateInstallation.open(given.orElseGet(OpenInTrackMateCommand::chosen));
    }

    /** The file that a macro names. */
    static Path given(String options) {
        String file =
                CommandOptions.of(options, "MEMTrack Open in TrackMate", "file").getOrDefault("file", "");
        if (file.isEmpty()) {
            throw new DetectorException("No file of tracks is given: give file=[/path/to/tracks.xml].");
        }
        return existing(file);
    }

    private static Path chosen() {
        String file = new OpenDialog(QUESTION).getPath();
        if (file == null) {
            throw new CancellationException();
        }
        return existing(file);
    }

    private static Path existing(String file) {
        Path path = GivenPath.of(file);
        if (!Files.isRegularFile(path)) {
            throw new DetectorException("There is no file %s: give file=[/path/to/tracks.xml].".formatted(path));
        }
        return path;
    }
}
