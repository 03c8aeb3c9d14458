// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import ij.IJ;
import ij.ImagePlus;
import java.util.List;
import java.util.Map;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.DetectionSummary;
import org.memtrack.client.ModelInUse;
import org.memtrack.client.ServerInfo;
import org.memtrack.client.Thresholds;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.Provenance;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.tracking.Track;
import org.memtrack.video.Film;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.ImageFilm;

/** A film of nine frames and what a run found in it. */
final class SmallRun {
    private SmallRun() {}

    static Film film() {
        ImagePlus image = IJ.createImage("film.tif", "8-bit ramp", 60, 40, 9);
        image.setDimensions(1, 1, 9);
        return new ImageFilm(image, FilmOptions.DEFAULTS);
    }

    static TrackingResult result(Film film, Track... tracks) {
        return result(film, List.of(), tracks);
    }

    /** With the frames that tell the drift of the stage. */
    static TrackingResult result(Film film, List<FrameDetections> drift, Track... tracks) {
        return new TrackingResult(
                TrackedFilm.of(film.info(), List.of(tracks), drift),
                3,
                new DetectionResult(
                        List.of(),
                        new DetectionSummary(9, 8, 1, 2, 1, 0, 4, 0.1, "f".repeat(64), Map.of(), List.of()),
                        new ModelInUse(
                                "default", "5", "m".repeat(64), new Thresholds(0.5, 0.6, 0.7), 1, "none", List.of())),
                new ServerInfo(1, "0.1.0", "3.11.2", Map.of(), List.of(), 0, 0),
                List.of());
    }

    static Provenance origin(Film film, TrackingResult result) {
        return Origin.of(film, result, Map.of("output", "out"), List.of());
    }
}
