// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.IJ;
import ij.ImagePlus;
import ij.Macro;
import ij.WindowManager;
import ij.plugin.PlugIn;
import java.awt.GraphicsEnvironment;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.MacroOptions;
import org.memtrack.macro.TrackRequest;
import org.memtrack.run.Origin;
import org.memtrack.run.ResultFiles;
import org.memtrack.run.TrackingResult;
import org.memtrack.run.TrackingRun;
import org.memtrack.run.TrackingSettings;
import org.memtrack.video.ImageFilm;
import org.memtrack.video.Regions;

/** The command "MEMTrack Track": tracks the open film, as a macro or the dialog says. */
public final class TrackCommand implements PlugIn {
    @Override
    public void run(String argument) {
        Commands.run(TrackCommand::track);
    }

    private static void track() {
        ImagePlus image = WindowManager.getCurrentImage();
        if (image == null) {
            throw new DetectorException("No film is open: open one first, with File > Open or File > Import.");
        }
        Optional<TrackRequest> request = request(image, Macro.getOptions());
        if (request.isPresent()) {
            track(image, request.get(), new StatusProgress());
        }
    }

    private static Optional<TrackRequest> request(ImagePlus image, @Nullable String options) {
        if (options != null || GraphicsEnvironment.isHeadless()) {
            return Optional.of(TrackRequest.of(MacroOptions.of(options == null ? "" : options)));
        }
        Optional<TrackRequest> request = TrackDialog.ask(image);
        request.ifPresent(wanted -> RecordedLine.write(wanted.options()));
        return request;
    }

    static void track(ImagePlus image, TrackRequest request, Progress progress) {
        try (LockedImage locked = new LockedImage(image)) {
            track(image, locked.film(request.film()), request, progress);
        }
    }

    private static void track(ImagePlus image, ImageFilm film, TrackRequest request, Progress progress) {
        ResultFiles files = ResultFiles.in(request.output(), film);
        int frameCount = film.info().frameCount();
        TrackingSettings settings = request.settingsFor(frameCount);
        settings =
                settings.with(settings.detection().withRegion(Regions.of(image).orElse(null)));
        Map<String, Object> inForce = new LinkedHashMap<>(request.optionsFor(frameCount));
        Map<String, Object> region = Regions.describe(image);
        if (!region.isEmpty()) {
            inForce.put("region", region);
        }
        TrackingResult result = TrackingRun.run(film, settings, progress);
        List<String> warnings = new ArrayList<>(film.warnings());
        warnings.addAll(request.warningsFor(frameCount));
        warnings.addAll(result.warnings());
        files.write(result, film, Origin.of(film, result, inForce, List.copyOf(warnings)))
                .ifPresent(warnings::add);
        if (request.overlay() && !GraphicsEnvironment.isHeadless()) {
            TrackOverlay.show(image, film, result.tracked().tracks()).ifPresent(TrackCommand::note);
        }
        IJ.log("MEMTrack: " + result.describe());
        warnings.forEach(TrackCommand::note);
        IJ.log("MEMTrack: results in " + files.folder());
        IJ.showStatus("MEMTrack: " + result.describe());
    }

    private static void note(String sentence) {
        IJ.log("MEMTrack, note: " + sentence);
    }
}
