// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.Macro;
import ij.io.OpenDialog;
import ij.plugin.PlugIn;
import ij.plugin.frame.Recorder;
import java.awt.GraphicsEnvironment;
import java.nio.file.Files;
import java.util.concurrent.CancellationException;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.GivenPath;
import org.memtrack.macro.OptionLine;
import org.memtrack.trackmate.TrackMateInstallation;

/** The command "MEMTrack Open in TrackMate": opens the tracks of an earlier run over their film, in TrackMate's window. */
public final class OpenInTrackMateCommand implements PlugIn {
    @Override
    public void run(String argument) {
        Commands.run(OpenInTrackMateCommand::open);
    }

    private static void open() {
        TrackMateInstallation.problem().ifPresent(sentence -> {
            throw new DetectorException(sentence);
        });
        String options = Macro.getOptions();
        if (GraphicsEnvironment.isHeadless()) {
            throw new DetectorException("TrackMate's window needs a screen; without one, read the .csv of the run.");
        }
        String file = options == null
                ? new OpenDialog("Tracks (.xml)").getPath()
                : OptionLine.parse(options).get("file");
        if (file == null && options == null) {
            throw new CancellationException();
        }
        if (file == null || !Files.isRegularFile(GivenPath.of(file))) {
            throw new DetectorException("There is no file %s: give file=[/path/to/tracks.xml].".formatted(file));
        }
        if (options == null && Recorder.record) {
            Recorder.recordOption("file", file.replace('\\', '/'));
        }
        TrackMateInstallation.open(GivenPath.of(file));
    }
}
