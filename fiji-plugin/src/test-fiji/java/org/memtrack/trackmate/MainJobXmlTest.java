// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.io.TmXmlReader;
import ij.IJ;
import ij.ImagePlus;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.OptionalDouble;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.StreamSupport;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Progress;
import org.memtrack.formats.TrackMateXml;
import org.memtrack.run.TrackingResult;
import org.memtrack.run.TrackingRun;
import org.memtrack.run.TrackingSettings;
import org.memtrack.server.ServerSettings;
import org.memtrack.testing.ExaminationData;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;
import org.memtrack.video.ImageFilm;

/** TrackMate's own reader opens the file that the main command writes, with its film. */
@Timeout(240)
class MainJobXmlTest {
    private static final double PIXEL_SIZE = 0.4545;
    private static final double INTERVAL = 1 / 26.87;

    @Test
    void trackMateReadsWhatTheMainCommandWrites(@TempDir Path folder) throws Exception {
        Path copy = folder.resolve("film of bacteria.tif");
        Files.copy(ExaminationData.path("bacteria_water", "bacteria_water_TL.tif"), copy);
        ImagePlus image = IJ.openImage(copy.toString());
        FilmOptions options = new FilmOptions(
                image.getNFrames() > 1 ? FrameAxis.T : FrameAxis.Z,
                1,
                1,
                0,
                OptionalDouble.of(PIXEL_SIZE),
                OptionalDouble.of(INTERVAL));
        TrackingSettings settings = new TrackingSettings(
                DetectionSettings.DEFAULTS, SortSettings.WATER, ServerSettings.DEFAULTS, true);
        TrackingResult result = TrackingRun.run(new ImageFilm(image, options), settings, Progress.NONE);
        List<Track> tracks = result.tracked().tracks();
        Path xml = folder.resolve("tracks.xml");
        TrackMateXml.write(xml, result.tracked());

        TmXmlReader reader = new TmXmlReader(xml.toFile());
        Model model = reader.getModel();
        assertThat(reader.getDisplaySettings()).isNotNull();
        assertThat(reader.isReadingOk()).as(reader.getErrorMessage()).isTrue();
        assertThat(model.getTrackModel().nTracks(true)).isEqualTo(tracks.size()).isPositive();
        int points = tracks.stream().mapToInt(Track::length).sum();
        int spotsOfTracks = model.getTrackModel().trackIDs(true).stream()
                .mapToInt(id -> model.getTrackModel().trackSpots(id).size())
                .sum();
        assertThat(spotsOfTracks).isEqualTo(points);
        List<Spot> spots = StreamSupport.stream(model.getSpots().iterable(true).spliterator(), false)
                .toList();
        assertThat(spots).hasSizeGreaterThanOrEqualTo(points).allSatisfy(MainJobXmlTest::isComplete);
        assertThat(spots.stream().filter(Spots::interpolated).count())
                .isEqualTo(tracks.stream()
                        .flatMap(track -> track.points().stream())
                        .filter(TrackPoint::interpolated)
                        .count());
        assertThat(model.getFeatureModel().getSpotFeatureNames())
                .containsKeys("MEMTRACK_INTERPOLATED", "MEMTRACK_LEVEL", "MEMTRACK_SCORE", "MEMTRACK_BOX_WIDTH");
        TrackPoint first = tracks.get(0).points().get(0);
        Map<Double, Spot> byX = spots.stream()
                .filter(spot -> Spots.frame(spot) == first.frame())
                .collect(Collectors.toMap(
                        spot -> Math.abs(spot.getDoublePosition(0) / PIXEL_SIZE
                                        - first.box().centreX())
                                + Math.abs(spot.getDoublePosition(1) / PIXEL_SIZE
                                        - first.box().centreY()),
                        Function.identity(),
                        (one, other) -> one));
        assertThat(byX.keySet().stream().mapToDouble(Double::doubleValue).min().orElseThrow())
                .isCloseTo(0, within(1e-3));

        ImagePlus reopened = reader.readImage();
        assertThat(reopened.getWidth()).isEqualTo(660);
        Settings read = reader.readSettings(reopened);
        assertThat(reader.isReadingOk()).as(reader.getErrorMessage()).isTrue();
        assertThat(read.nframes).isEqualTo(60);
        assertThat(read.dx).isCloseTo(PIXEL_SIZE, within(1e-9));
        assertThat(read.dt).isCloseTo(INTERVAL, within(1e-9));
        model.getTrackModel().edgeSet().forEach(edge -> assertThat(
                        model.getFeatureModel().getEdgeFeature(edge, "LINK_COST"))
                .isBetween(0.0, 1.0));

        TmXmlReader calibrating = new TrackMateWindow.CalibratingReader(xml.toFile());
        calibrating.getModel();
        ImagePlus calibrated = calibrating.readImage();
        assertThat(calibrated.getCalibration().pixelWidth).isEqualTo(1);
        assertThat(calibrated.getNFrames()).isEqualTo(60);
        calibrating.readSettings(calibrated);
        assertThat(calibrated.getCalibration().pixelWidth).isCloseTo(PIXEL_SIZE, within(1e-9));
        assertThat(calibrated.getCalibration().frameInterval).isCloseTo(INTERVAL, within(1e-9));

        // TrackMate's own reader leaves the film as its file has it; our actions take the tracks' word for it.
        ModelTracks ours = ModelTracks.of(new TrackMate(model, read));
        assertThat(ours.info().frameCount()).isEqualTo(60);
        assertThat(ours.info().pixelSizeMicrometres().orElseThrow()).isCloseTo(PIXEL_SIZE, within(1e-9));
        assertThat(ours.tracked().tracks()).hasSameSizeAs(tracks);
        assertThat(MotilityAction.table(ours).size()).isEqualTo(tracks.size());

        read.addAllAnalyzers();
        TrackMate trackmate = new TrackMate(model, read);
        assertThat(trackmate.computeSpotFeatures(false) && trackmate.computeEdgeFeatures(false)
                        && trackmate.computeTrackFeatures(false))
                .as(trackmate.getErrorMessage())
                .isTrue();
    }

    private static void isComplete(Spot spot) {
        assertThat(spot.getFeatures())
                .containsKeys("QUALITY", "RADIUS", "POSITION_X", "POSITION_Y", "POSITION_Z", "FRAME", "VISIBILITY");
        assertThat(spot.getFeature(Spot.POSITION_T)).isCloseTo(Spots.frame(spot) * INTERVAL, within(1e-9));
    }
}
