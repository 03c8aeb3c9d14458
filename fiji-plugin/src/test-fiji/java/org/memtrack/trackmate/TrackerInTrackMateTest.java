// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import fiji.plugin.trackmate.Logger;
import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.detection.LogDetectorFactory;
import fiji.plugin.trackmate.features.FeatureFilter;
import fiji.plugin.trackmate.io.TmXmlReader;
import fiji.plugin.trackmate.io.TmXmlWriter;
import fiji.plugin.trackmate.tracking.jaqaman.SparseLAPTrackerFactory;
import ij.IJ;
import ij.ImagePlus;
import java.io.File;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Collectors;
import java.util.stream.StreamSupport;
import org.jgrapht.alg.connectivity.ConnectivityInspector;
import org.jgrapht.graph.DefaultWeightedEdge;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.SpotFeature;
import org.memtrack.testing.RandomWorld;
import org.memtrack.tracking.Field;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.SortTracker;
import org.memtrack.tracking.Track;

/** The tracker on spots of TrackMate's own detector and of ours, and what TrackMate does with its result. */
class TrackerInTrackMateTest {
    private static final String INTERPOLATED = "MEMTRACK_INTERPOLATED";

    static TrackMate logAndSort(ImagePlus film, double radius, double threshold, int minimumTrackLength) {
        Settings settings = new Settings(film);
        settings.detectorFactory = new LogDetectorFactory<>();
        settings.detectorSettings = settings.detectorFactory.getDefaultSettings();
        settings.detectorSettings.put("RADIUS", radius);
        settings.detectorSettings.put("THRESHOLD", threshold);
        settings.trackerFactory = new MemtrackTrackerFactory();
        settings.trackerSettings = settings.trackerFactory.getDefaultSettings();
        settings.trackerSettings.put("MINIMUM_TRACK_LENGTH", minimumTrackLength);
        settings.addAllAnalyzers();
        TrackMate trackmate = new TrackMate(settings);
        trackmate.setNumThreads(1);
        return trackmate;
    }

    private static TrackMate tracked() {
        return tracked(Films.twoSwimmers(20));
    }

    private static TrackMate tracked(ImagePlus film) {
        TrackMate trackmate = logAndSort(film, 4 * Films.PIXEL_SIZE, 20, 10);
        assertThat(trackmate.checkInput()).as(trackmate.getErrorMessage()).isTrue();
        assertThat(trackmate.process()).as(trackmate.getErrorMessage()).isTrue();
        return trackmate;
    }

    static List<Spot> spots(Model model, double interpolated) {
        return StreamSupport.stream(model.getSpots().iterable(true).spliterator(), false)
                .filter(spot -> spot.getFeature(INTERPOLATED) == interpolated)
                .toList();
    }

    @Test
    void twoSwimmersAreTwoTracksAndTheGapIsFilledWithSpots() {
        Model model = tracked().getModel();
        assertThat(model.getTrackModel().nTracks(true)).isEqualTo(2);
        for (int id : model.getTrackModel().trackIDs(true)) {
            assertThat(model.getTrackModel().trackSpots(id)).hasSize(20);
            assertThat(model.getTrackModel().trackEdges(id)).hasSize(19);
        }
        List<Spot> added = spots(model, 1);
        assertThat(added.stream().map(spot -> spot.getFeature(Spot.FRAME).intValue())).containsExactlyInAnyOrder(8, 9, 10);
        for (Spot spot : added) {
            double frame = spot.getFeature(Spot.FRAME);
            assertThat(spot.getFeature(Spot.POSITION_X)).isCloseTo((12 + 2 * frame) * Films.PIXEL_SIZE, within(0.1));
            assertThat(spot.getFeature(Spot.POSITION_Y)).isCloseTo(20 * Films.PIXEL_SIZE, within(0.1));
            assertThat(spot.getFeature(Spot.POSITION_T)).isCloseTo(frame * Films.INTERVAL, within(1e-9));
            assertThat(spot.getFeature(Spot.RADIUS)).isCloseTo(4 * Films.PIXEL_SIZE, within(1e-9));
            assertThat(spot.getFeature(Spot.QUALITY)).isZero();
        }
    }

    /** Dense, with many spurious boxes: their debris must be dropped before tracks that share a swimmer are joined. */
    @ParameterizedTest
    @ValueSource(longs = {1, 4, 8})
    void spotsOfTheMemtrackDetectorAreTheTracksOfTheMenuCommand(long seed) {
        List<FrameDetections> frames = RandomWorld.of(
                        new RandomWorld.Settings(200, 150, 100, 25, 1, 0.05, 30, 3, 0.3, 0.02, 0.2, 12), seed)
                .frames();
        SortSettings sort = SortSettings.WATER;
        List<Track> expected = new SortTracker(sort, new Field(200, 150)).track(frames);

        SpotCollection spots = new SpotCollection();
        frames.forEach(frame -> frame.detections().forEach(detection -> spots.add(spot(detection), frame.frame())));
        ImagePlus image = IJ.createImage("film", "8-bit black", 200, 150, 1);
        MemtrackTracker tracker = new MemtrackTracker(spots, TrackerSettings.toMap(sort), image);
        StringBuilder said = new StringBuilder();
        tracker.setLogger(new Logger.StringBuilderLogger(said));
        assertThat(tracker.checkInput()).as(tracker.getErrorMessage()).isTrue();
        assertThat(tracker.process()).as(tracker.getErrorMessage()).isTrue();

        assertThat(new ConnectivityInspector<>(tracker.getResult())
                        .connectedSets().stream().map(TrackerInTrackMateTest::places))
                .containsExactlyInAnyOrderElementsOf(expected.stream()
                        .map(track -> track.points().stream()
                                .map(point -> place(
                                        point.frame(),
                                        point.box().centreX(),
                                        point.box().centreY()))
                                .collect(Collectors.toSet()))
                        .toList());
        assertThat(said).contains("%d tracks kept".formatted(expected.size())).doesNotContain("score was not asked");
    }

    private static Spot spot(Detection detection) {
        Box box = detection.box();
        Spot spot = Spots.at(box.centreX(), box.centreY(), (box.width() + box.height()) / 4, detection.score());
        spot.putFeature("MEMTRACK_LEVEL", (double) SpotFeature.codeOf(detection.level()));
        spot.putFeature("MEMTRACK_BOX_WIDTH", box.width());
        spot.putFeature("MEMTRACK_BOX_HEIGHT", box.height());
        return spot;
    }

    private static Set<String> places(Set<Spot> track) {
        return track.stream()
                .map(spot -> place(Spots.frame(spot), spot.getDoublePosition(0), spot.getDoublePosition(1)))
                .collect(Collectors.toSet());
    }

    private static String place(int frame, double x, double y) {
        return String.format(Locale.ROOT, "%d: %.3f, %.3f", frame, x, y);
    }

    @Test
    void ofSpotsWithoutScoresItIsSaidThatNoneIsAsked() {
        TrackMate trackmate = logAndSort(Films.twoSwimmers(20), 4 * Films.PIXEL_SIZE, 20, 10);
        StringBuilder said = new StringBuilder();
        trackmate.getModel().setLogger(new Logger.StringBuilderLogger(said));
        assertThat(trackmate.process()).as(trackmate.getErrorMessage()).isTrue();
        assertThat(said).contains("2 tracks kept", "The least track score was not asked");
    }

    @Test
    void whatToDoIsSaidWhereEveryTrackIsDropped() {
        TrackMate trackmate = logAndSort(Films.twoSwimmers(20), 4 * Films.PIXEL_SIZE, 20, 21);
        StringBuilder said = new StringBuilder();
        trackmate.getModel().setLogger(new Logger.StringBuilderLogger(said));
        assertThat(trackmate.process()).as(trackmate.getErrorMessage()).isTrue();
        assertThat(said).contains("0 tracks kept", "2 too short", "lower the least track length");
    }

    @Test
    void aTrackThatLacksSpotsIsJoinedAcrossTheHole() {
        TrackMate trackmate = tracked();
        trackmate.getSettings().trackerSettings.putAll(Map.of("INTERPOLATION", "AUTHORS", "MINIMUM_HITS", 2));
        assertThat(trackmate.execTracking()).as(trackmate.getErrorMessage()).isTrue();
        Model model = trackmate.getModel();
        assertThat(model.getTrackModel().nTracks(true)).isEqualTo(2);
        // As in SORT, frame 8 is predicted; then the track must be found twice in a row before it is told again.
        assertThat(model.getTrackModel().trackIDs(true).stream()
                        .map(id -> model.getTrackModel().trackSpots(id).size()))
                .containsExactlyInAnyOrder(17, 20);
    }

    @Test
    void interpolatedSpotsHaveEveryFeatureThatObservedOnesHave() {
        Model model = tracked().getModel();
        Set<String> observed = spots(model, 0).get(0).getFeatures().keySet();
        assertThat(observed).contains("MEAN_INTENSITY_CH1", "SNR_CH1");
        spots(model, 1).forEach(spot -> assertThat(spot.getFeatures()).containsKeys(observed.toArray(String[]::new)));
    }

    @Test
    void runningAgainReplacesWhatWasInterpolated() {
        TrackMate trackmate = tracked();
        int spots = trackmate.getModel().getSpots().getNSpots(false);
        assertThat(spots).isEqualTo(40);
        assertThat(trackmate.execTracking()).isTrue();
        assertThat(trackmate.getModel().getSpots().getNSpots(false)).isEqualTo(spots);

        trackmate.getSettings().trackerSettings.put("MAXIMUM_AGE", 1);
        assertThat(trackmate.execTracking()).isTrue();
        assertThat(spots(trackmate.getModel(), 1)).isEmpty();
        assertThat(trackmate.getModel().getSpots().getNSpots(false)).isEqualTo(37);
    }

    @Test
    void linkCostIsOneLessTheOverlap() {
        Model model = tracked().getModel();
        for (DefaultWeightedEdge edge : model.getTrackModel().edgeSet()) {
            double cost = model.getFeatureModel().getEdgeFeature(edge, "LINK_COST");
            // Squares of 8 px, 2 px apart: they share 6 of 10 columns.
            assertThat(cost).isCloseTo(0.4, within(0.01));
        }
    }

    @Test
    void filtersColoursAndEditsWorkOnInterpolatedSpots() {
        TrackMate trackmate = tracked();
        Model model = trackmate.getModel();
        assertThat(model.getFeatureModel().getSpotFeatureNames()).containsKey(INTERPOLATED);
        trackmate.getSettings().addSpotFilter(new FeatureFilter(INTERPOLATED, 0.5, false));
        assertThat(trackmate.execSpotFiltering(false)).isTrue();
        assertThat(model.getSpots().getNSpots(true)).isEqualTo(37);
        trackmate.getSettings().clearSpotFilters();
        assertThat(trackmate.execSpotFiltering(false)).isTrue();

        Spot added = spots(model, 1).get(1);
        model.beginUpdate();
        try {
            model.removeSpot(added);
        } finally {
            model.endUpdate();
        }
        assertThat(model.getTrackModel().nTracks(true)).isEqualTo(3);
    }

    @Test
    void whatTrackMateSavesItReadsBackEqual(@TempDir Path folder) throws Exception {
        ImagePlus film = Films.twoSwimmers(20);
        IJ.saveAsTiff(film, folder.resolve("film.tif").toString());
        TrackMate trackmate = tracked(IJ.openImage(folder.resolve("film.tif").toString()));
        File file = folder.resolve("tracks.xml").toFile();
        TmXmlWriter writer = new TmXmlWriter(file);
        writer.appendModel(trackmate.getModel());
        writer.appendSettings(trackmate.getSettings());
        writer.writeToFile();

        TmXmlReader reader = new TmXmlReader(file);
        Model read = reader.getModel();
        assertThat(reader.isReadingOk()).as(reader.getErrorMessage()).isTrue();
        assertEqual(read, trackmate.getModel());
        Settings settings = reader.readSettings(reader.readImage());
        assertThat(reader.isReadingOk()).as(reader.getErrorMessage()).isTrue();
        assertThat(settings.trackerFactory).isInstanceOf(MemtrackTrackerFactory.class);
        assertThat(settings.trackerSettings).isEqualTo(trackmate.getSettings().trackerSettings);
    }

    @Test
    void interpolatedSpotsOfAReloadedFileAreReplacedToo(@TempDir Path folder) throws Exception {
        TrackMate trackmate = tracked();
        File file = folder.resolve("tracks.xml").toFile();
        TmXmlWriter writer = new TmXmlWriter(file);
        writer.appendModel(trackmate.getModel());
        writer.writeToFile();
        Model read = new TmXmlReader(file).getModel();
        TrackMate again = new TrackMate(read, trackmate.getSettings());
        assertThat(again.execTracking()).isTrue();
        assertThat(read.getSpots().getNSpots(false)).isEqualTo(40);
        assertThat(read.getTrackModel().nTracks(true)).isEqualTo(2);
    }

    @Test
    void aSettingOfAnOlderVersionIsCompletedAndAForeignOneRefused(@TempDir Path folder) throws Exception {
        TrackMate trackmate = tracked();
        File file = folder.resolve("tracks.xml").toFile();
        TmXmlWriter writer = new TmXmlWriter(file);
        writer.appendModel(trackmate.getModel());
        writer.appendSettings(trackmate.getSettings());
        writer.writeToFile();
        String xml = java.nio.file.Files.readString(file.toPath());
        assertThat(xml).contains(" ASSOCIATION=\"MOTION\"");
        java.nio.file.Files.writeString(file.toPath(), xml.replace(" ASSOCIATION=\"MOTION\"", ""));
        TmXmlReader reader = new TmXmlReader(file);
        reader.getModel();
        Map<String, Object> completed = reader.readSettings(trackmate.getSettings().imp).trackerSettings;
        assertThat(reader.isReadingOk()).as(reader.getErrorMessage()).isTrue();
        assertThat(completed).isEqualTo(trackmate.getSettings().trackerSettings);

        java.nio.file.Files.writeString(file.toPath(), xml.replace(" ASSOCIATION=\"MOTION\"", " FUTURE=\"1\""));
        TmXmlReader foreign = new TmXmlReader(file);
        foreign.getModel();
        foreign.readSettings(trackmate.getSettings().imp);
        assertThat(foreign.isReadingOk()).isFalse();
        assertThat(foreign.getErrorMessage()).contains("FUTURE").contains("update MEMTrack");
    }

    @Test
    void badSettingsAreRefusedBeforeTheRunWithOneSentence() {
        TrackMate trackmate = logAndSort(Films.twoSwimmers(3), 1, 2, 1);
        trackmate.getSettings().trackerSettings.put("IOU_GATE", 1.5);
        assertThat(trackmate.checkInput()).isFalse();
        assertThat(trackmate.getErrorMessage()).contains("IoU gate must lie in [0, 1), not 1.5");
    }

    @Test
    void cancelledTrackingEndsWithoutTracks() {
        TrackMate trackmate = tracked();
        MemtrackTracker tracker = new MemtrackTracker(
                trackmate.getModel().getSpots(), trackmate.getSettings().trackerSettings, trackmate.getSettings().imp);
        tracker.cancel("enough");
        assertThat(tracker.checkInput()).isTrue();
        assertThat(tracker.process()).isTrue();
        assertThat(tracker.isCanceled()).isTrue();
        assertThat(tracker.getCancelReason()).isEqualTo("enough");
        assertThat(tracker.getResult().vertexSet()).isEmpty();
        assertThat(trackmate.getModel().getSpots().getNSpots(false)).isEqualTo(40);
    }

    @Test
    void trackMatesOwnFilmIsTracked() {
        ImagePlus film = Films.fakeTracks();
        TrackMate trackmate = logAndSort(film, 2.5 * film.getCalibration().pixelWidth, 30, 10);
        assertThat(trackmate.process()).as(trackmate.getErrorMessage()).isTrue();
        int sort = trackmate.getModel().getTrackModel().nTracks(true);
        assertThat(sort).isBetween(2, 8);
        Set<Integer> frames = trackmate.getModel().getTrackModel().vertexSet().stream()
                .map(spot -> spot.getFeature(Spot.FRAME).intValue())
                .collect(Collectors.toCollection(TreeSet::new));
        assertThat(frames).hasSizeGreaterThan(40);

        trackmate.getSettings().trackerFactory = new SparseLAPTrackerFactory();
        trackmate.getSettings().trackerSettings = trackmate.getSettings().trackerFactory.getDefaultSettings();
        assertThat(trackmate.execTracking()).isTrue();
    }

    /** Equal spots with their features, equal tracks as sets of spots, equal features of edges. */
    static void assertEqual(Model read, Model written) {
        assertThat(features(read)).isEqualTo(features(written));
        assertThat(tracks(read)).isEqualTo(tracks(written));
        assertThat(costs(read)).isEqualTo(costs(written));
        assertThat(read.getSpaceUnits()).isEqualTo(written.getSpaceUnits());
        assertThat(read.getFeatureModel().getSpotFeatureNames())
                .isEqualTo(written.getFeatureModel().getSpotFeatureNames());
    }

    private static Map<Integer, Map<String, Double>> features(Model model) {
        return StreamSupport.stream(model.getSpots().iterable(false).spliterator(), false)
                .collect(Collectors.toMap(Spot::ID, spot -> Map.copyOf(spot.getFeatures())));
    }

    private static Set<Set<Integer>> tracks(Model model) {
        return model.getTrackModel().trackIDs(false).stream()
                .map(id -> model.getTrackModel().trackSpots(id).stream().map(Spot::ID).collect(Collectors.toSet()))
                .collect(Collectors.toSet());
    }

    private static Map<String, Double> costs(Model model) {
        return model.getTrackModel().edgeSet().stream()
                .collect(Collectors.toMap(
                        edge -> model.getTrackModel().getEdgeSource(edge).ID() + "-"
                                + model.getTrackModel().getEdgeTarget(edge).ID(),
                        edge -> model.getFeatureModel().getEdgeFeature(edge, "LINK_COST")));
    }
}
