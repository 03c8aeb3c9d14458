// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;

import ij.IJ;
import java.util.List;
import java.util.Map;
import java.util.OptionalDouble;
import org.junit.jupiter.api.Test;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.DetectionSummary;
import org.memtrack.client.ModelInUse;
import org.memtrack.client.ServerInfo;
import org.memtrack.client.Thresholds;
import org.memtrack.detection.Box;
import org.memtrack.formats.Provenance;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.Film;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;
import org.memtrack.video.ImageFilm;

class OriginTest {
    @Test
    void pointsAreCountedAndNotTheFramesThatATrackSpans() {
        Film film = SmallRun.film();
        Box box = Box.around(20, 20, 8, 4);
        Track track = new Track(0, List.of(new TrackPoint(1, box, null), new TrackPoint(7, box, null)));
        assertThat(SmallRun.origin(film, SmallRun.result(film, track)).counts())
                .containsEntry("tracks", 1L)
                .containsEntry("points", 2L)
                .containsEntry("interpolated_points", 2L);
    }

    @Test
    void itTellsWhatEachStageTook() {
        Map<String, Double> seconds = Map.of("Background", 1.5, "Detecting", 20.25);
        DetectionSummary summary = new DetectionSummary(1, 9, 1, 2, 3, 1, 2, 0.2, "def", seconds);
        ModelInUse model =
                new ModelInUse("default", "5", "abc", new Thresholds(0.5, 0.6, 0.7), 1, "openvino", List.of());
        ServerInfo server = new ServerInfo(1, "0.1.0", "3.11", Map.of(), List.of(), 1, 1);
        Film film = new ImageFilm(
                IJ.createImage("film", "8-bit", 20, 10, 1),
                new FilmOptions(FrameAxis.T, 1, 1, 0, OptionalDouble.empty(), OptionalDouble.empty()));
        TrackingResult result = new TrackingResult(
                new TrackedFilm(film.info(), List.of(), List.of()),
                List.of(),
                new DetectionResult(List.of(), summary, model),
                server,
                List.of());

        Provenance provenance = Origin.of(film, result, Map.of(), List.of());

        assertThat(provenance.seconds()).isEqualTo(seconds);
        assertThat(provenance.counts()).containsEntry("near_misses", 2L);
    }
}
