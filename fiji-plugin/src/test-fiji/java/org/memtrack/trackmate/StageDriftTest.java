// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.io.TmXmlReader;
import fiji.plugin.trackmate.io.TmXmlWriter;
import ij.ImagePlus;
import ij.ImageStack;
import ij.measure.ResultsTable;
import ij.process.ByteProcessor;
import java.io.File;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Progress;
import org.memtrack.formats.MotilityCsv;
import org.memtrack.run.Origin;
import org.memtrack.run.ResultFiles;
import org.memtrack.run.TrackingResult;
import org.memtrack.run.TrackingRun;
import org.memtrack.run.TrackingSettings;
import org.memtrack.server.ServerSettings;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.TrackFilter;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.ImageFilm;

/** A stage that jumps 20 px right and 30 px up in frame 15, under cells that swim 1 px right a frame. */
@Timeout(240)
class StageDriftTest {
    private static final int FRAMES = 40;
    private static final int JUMP = 15;
    private static final double JUMP_X = 20;
    private static final double JUMP_Y = -30;

    @Test
    void tracksGoOnAndSpeedsAreThoseOfTheCellsAlsoAfterReloading(@TempDir Path folder) throws Exception {
        TrackMate trackmate = trackmate(film());
        SpotCollection spots = new SpotCollection();
        for (int frame = 0; frame < FRAMES; frame++) {
            for (int cell = 0; cell < 3; cell++) {
                // The first is missed around the jump.
                if (cell > 0 || frame < JUMP - 2 || frame > JUMP + 1) {
                    spots.add(spot(frame, cell), frame);
                }
            }
        }
        trackmate.getModel().setSpots(spots, false);
        assertThat(trackmate.execTracking()).as(trackmate.getErrorMessage()).isTrue();
        assertThat(trackmate.computeEdgeFeatures(false) && trackmate.computeTrackFeatures(false)).isTrue();
        isRight(trackmate);

        File file = folder.resolve("tracks.xml").toFile();
        TmXmlWriter writer = new TmXmlWriter(file);
        writer.appendModel(trackmate.getModel());
        writer.writeToFile();
        TrackMate reloaded = new TrackMate(new TmXmlReader(file).getModel(), trackmate.getSettings());
        isRight(reloaded);
        assertThat(reloaded.execTracking()).as(reloaded.getErrorMessage()).isTrue();
        isRight(reloaded);
    }

    private static void isRight(TrackMate trackmate) {
        Model model = trackmate.getModel();
        assertThat(model.getTrackModel().nTracks(true)).isEqualTo(3);
        for (Spot spot : TrackerInTrackMateTest.spots(model, 1)) {
            int frame = Spots.frame(spot);
            assertThat(spot.getDoublePosition(0)).isCloseTo(x(frame, 0) * Films.PIXEL_SIZE, within(0.2));
            assertThat(spot.getDoublePosition(1)).isCloseTo(y(frame, 0) * Films.PIXEL_SIZE, within(0.2));
        }
        ResultsTable table = MotilityAction.table(ModelTracks.of(trackmate));
        for (int row = 0; row < 3; row++) {
            assertThat(table.getValue("Frames", row)).isEqualTo(FRAMES);
            assertThat(table.getValue("Speed (px/frame)", row)).isCloseTo(1, within(0.05));
        }
    }

    @Test
    void theDetectorTellsItWithEverySpot() {
        TrackMate trackmate = trackmate(film());
        trackmate.getSettings().detectorSettings.put("CELL_LENGTH_PX", 8.0);
        assertThat(trackmate.execDetection()).as(trackmate.getErrorMessage()).isTrue();
        List<Spot> spots = TrackerInTrackMateTest.spots(trackmate.getModel(), 0);
        assertThat(spots).hasSizeGreaterThan(FRAMES);
        for (Spot spot : spots) {
            boolean before = Spots.frame(spot) < JUMP;
            assertThat(spot.getFeature("MEMTRACK_DRIFT_X"))
                    .isCloseTo(before ? 0 : JUMP_X * Films.PIXEL_SIZE, within(0.25));
            assertThat(spot.getFeature("MEMTRACK_DRIFT_Y"))
                    .isCloseTo(before ? 0 : JUMP_Y * Films.PIXEL_SIZE, within(0.25));
        }
    }

    @Test
    void theFileOfTheMenuCommandHasTheMotilityOfItsTable(@TempDir Path folder) throws Exception {
        ImagePlus image = film();
        ImageFilm film = new ImageFilm(image, FilmOptions.DEFAULTS);
        TrackingSettings settings = new TrackingSettings(
                new DetectionSettings("", "", Criterion.MAXIMUM_F1, null, null, null, true, false, 8.0, null),
                SortSettings.DEFAULTS.with(TrackFilter.ofLength(10)),
                ServerSettings.DEFAULTS,
                true);
        TrackingResult result = TrackingRun.run(film, settings, Progress.NONE);
        assertThat(result.tracked().tracks()).isNotEmpty();
        ResultFiles files = ResultFiles.in(folder, film);
        files.write(result, film, Origin.of(film, result, Map.of(), List.of()));

        TrackMate opened = new TrackMate(new TmXmlReader(files.xml().toFile()).getModel(), new Settings(image));
        Path again = folder.resolve("again.csv");
        MotilityCsv.write(again, ModelTracks.of(opened).tracked());
        assertThat(again).hasSameTextualContentAs(files.motility());
        assertThat(TrackerInTrackMateTest.spots(opened.getModel(), 0))
                .filteredOn(spot -> Spots.frame(spot) >= JUMP)
                .isNotEmpty()
                .allSatisfy(spot -> assertThat(spot.getFeature("MEMTRACK_DRIFT_X"))
                        .isCloseTo(JUMP_X * Films.PIXEL_SIZE, within(0.25)));
    }

    private static Spot spot(int frame, int cell) {
        Spot spot = Spots.at(
                x(frame, cell) * Films.PIXEL_SIZE, y(frame, cell) * Films.PIXEL_SIZE, 4 * Films.PIXEL_SIZE, 0.9);
        spot.putFeature(Spot.POSITION_T, frame * Films.INTERVAL);
        spot.putFeature("MEMTRACK_DRIFT_X", frame < JUMP ? 0 : JUMP_X * Films.PIXEL_SIZE);
        spot.putFeature("MEMTRACK_DRIFT_Y", frame < JUMP ? 0 : JUMP_Y * Films.PIXEL_SIZE);
        return spot;
    }

    private static double x(int frame, int cell) {
        return 30 + 20 * cell + frame + (frame < JUMP ? 0 : JUMP_X);
    }

    private static double y(int frame, int cell) {
        return 60 + 40 * cell + (frame < JUMP ? 0 : JUMP_Y);
    }

    /** The cells over a grainy ground, which the stage moves with them. */
    private static ImagePlus film() {
        int size = 400;
        ByteProcessor ground = new ByteProcessor(size + 100, size + 100);
        Random random = new Random(1);
        for (int i = 0; i < ground.getPixelCount(); i++) {
            ground.set(i, random.nextInt(256));
        }
        ground.blurGaussian(4);
        ImageStack stack = new ImageStack(size, size);
        for (int frame = 0; frame < FRAMES; frame++) {
            int left = 50 - (frame < JUMP ? 0 : (int) JUMP_X);
            int top = 50 - (frame < JUMP ? 0 : (int) JUMP_Y);
            ByteProcessor pixels = new ByteProcessor(size, size);
            for (int y = 0; y < size; y++) {
                for (int x = 0; x < size; x++) {
                    double grey = ground.get(left + x, top + y);
                    for (int cell = 0; cell < 3; cell++) {
                        double dx = x - x(frame, cell);
                        double dy = y - y(frame, cell);
                        grey -= 70 * Math.exp(-dx * dx / 14 - dy * dy / 4);
                    }
                    pixels.set(x, y, (int) grey);
                }
            }
            stack.addSlice(pixels);
        }
        ImagePlus film = new ImagePlus("jumping stage", stack);
        film.setDimensions(1, 1, FRAMES);
        film.getCalibration().pixelWidth = Films.PIXEL_SIZE;
        film.getCalibration().pixelHeight = Films.PIXEL_SIZE;
        film.getCalibration().setUnit("micron");
        film.getCalibration().frameInterval = Films.INTERVAL;
        film.getCalibration().setTimeUnit("sec");
        return film;
    }

    private static TrackMate trackmate(ImagePlus film) {
        Settings settings = new Settings(film);
        settings.detectorFactory = new MemtrackDetectorFactory<>();
        settings.detectorSettings = settings.detectorFactory.getDefaultSettings();
        settings.trackerFactory = new MemtrackTrackerFactory();
        settings.trackerSettings = settings.trackerFactory.getDefaultSettings();
        settings.trackerSettings.put("MINIMUM_TRACK_LENGTH", 10);
        settings.addAllAnalyzers();
        TrackMate trackmate = new TrackMate(settings);
        trackmate.setNumThreads(1);
        return trackmate;
    }
}
