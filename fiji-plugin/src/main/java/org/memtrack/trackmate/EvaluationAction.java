// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.action.TrackMateAction;
import fiji.plugin.trackmate.action.TrackMateActionFactory;
import ij.IJ;
import ij.io.OpenDialog;
import ij.plugin.BrowserLauncher;
import java.awt.GraphicsEnvironment;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import javax.swing.ImageIcon;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.Progress;
import org.memtrack.server.PythonCommand;
import org.scijava.plugin.Plugin;

/** Compares the visible tracks with a ground truth. */
final class EvaluationAction extends ModelAction {
    /** Offers the action to TrackMate. */
    @Plugin(type = TrackMateActionFactory.class)
    public static final class Factory implements TrackMateActionFactory {
        @Override
        public TrackMateAction create() {
            return new EvaluationAction();
        }

        @Override
        public String getKey() {
            return "MEMTRACK_EVALUATION";
        }

        @Override
        public String getName() {
            return "Evaluate against ground truth (MEMTrack)";
        }

        @Override
        public String getInfoText() {
            return "<html>Compares the visible tracks with a ground truth: an MTrackJ file (.mdf), a TrackMate file (.xml) or a"
                    + " table (.csv). Boxes of truth and track match, one to one, when they overlap by more than 0.1 (IoU), as"
                    + " in the paper; where a spot has no box of MEMTrack's, a square of 30 pixels stands for it. Precision,"
                    + " recall, F1 and tracking measures come as a page beside the truth.</html>";
        }

        @Override
        public @Nullable ImageIcon getIcon() {
            return MemtrackIcon.SMALL;
        }
    }

    @Override
    void act(ModelTracks tracks) throws IOException {
        String beside = tracks.info()
                .file()
                .map(Path::getParent)
                .map(Path::toString)
                .orElseGet(OpenDialog::getDefaultDirectory);
        String file = new OpenDialog("Ground truth (.mdf, .xml, .csv)", beside, "").getPath();
        if (file == null) {
            throw new CancellationException();
        }
        compare(tracks, Path.of(file));
    }

    /** Compares with a truth and says what was found; Escape stops it, for TrackMate has no button to stop an action with. */
    void compare(ModelTracks tracks, Path truth) throws IOException {
        Path out = truth.resolveSibling(truth.getFileName() + " evaluation");
        say("Comparing … (Esc in a window of ImageJ stops it.)");
        IJ.resetEscape();
        evaluate(tracks, truth, out, new LoggerProgress(logger, IJ::escapePressed))
                .forEach(this::say);
        say("The whole comparison: " + out.resolve("evaluation.html"));
        if (!GraphicsEnvironment.isHeadless()) {
            BrowserLauncher.openURL(out.resolve("evaluation.html").toUri().toString());
        }
    }

    /**
     * Compares tracks with a truth, in Python.
     *
     * @param out folder for evaluation.html and evaluation.json; made if missing
     * @return what it found, in sentences
     * @throws CancellationException when progress was cancelled
     */
    static List<String> evaluate(ModelTracks tracks, Path truth, Path out, Progress progress) throws IOException {
        Path folder = Files.createTempDirectory("memtrack-evaluation");
        Path table = folder.resolve("tracks.csv");
        try {
            tracks.write(table);
            List<String> arguments = new ArrayList<>(List.of(
                    "evaluate",
                    "--truth",
                    truth.toAbsolutePath().toString(),
                    "--tracks",
                    table.toString(),
                    "--out",
                    out.toAbsolutePath().toString()));
            tracks.info()
                    .pixelSizeMicrometres()
                    .ifPresent(size -> arguments.addAll(List.of("--pixel-size-um", Double.toString(size))));
            tracks.info()
                    .frameIntervalSeconds()
                    .ifPresent(interval -> arguments.addAll(List.of("--frame-interval-s", Double.toString(interval))));
            PythonCommand.run(arguments, progress);
            return EvaluationSummary.of(out.resolve("evaluation.json"));
        } finally {
            Files.deleteIfExists(table);
            Files.deleteIfExists(folder);
        }
    }
}
