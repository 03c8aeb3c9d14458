// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import fiji.plugin.trackmate.Logger;
import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.io.TmXmlReader;
import fiji.plugin.trackmate.io.TmXmlWriter;
import ij.IJ;
import ij.ImagePlus;
import ij.ImageStack;
import ij.gui.OvalRoi;
import ij.gui.Roi;
import java.awt.Color;
import java.io.File;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.StreamSupport;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.testing.ExaminationData;

/** The detector, with the real server, on real swimming bacteria. */
@Timeout(240)
class DetectorInTrackMateTest {
    private static final double MICROMETRES_PER_PIXEL = 0.4545;

    private static ImagePlus water;

    @BeforeAll
    static void openFilm() {
        water = IJ.openImage(
                ExaminationData.path("bacteria_water", "bacteria_water_TL.tif").toString());
        water.setDimensions(1, 1, water.getStackSize());
        water.getCalibration().pixelWidth = MICROMETRES_PER_PIXEL;
        water.getCalibration().pixelHeight = MICROMETRES_PER_PIXEL;
        water.getCalibration().setUnit("um");
        water.getCalibration().frameInterval = 1 / 26.87;
        water.getCalibration().setTimeUnit("sec");
    }

    /** Collects the log. */
    private static final class Recorder extends Logger {
        final StringBuffer text = new StringBuffer();
        volatile double progress;
        volatile String status = "";
        volatile String lastWork = "";

        @Override
        public void log(String message, Color color) {
            text.append(message);
        }

        @Override
        public void log(String message) {
            text.append(message);
        }

        @Override
        public void error(String message) {
            text.append("ERROR ").append(message);
        }

        @Override
        public void setProgress(double fraction) {
            progress = fraction;
        }

        @Override
        public void setStatus(String status) {
            this.status = status;
            lastWork = status.isEmpty() ? lastWork : status;
        }
    }

    private static TrackMate trackmate(ImagePlus film, Recorder recorder) {
        Settings settings = new Settings(film);
        settings.detectorFactory = new MemtrackDetectorFactory<>();
        settings.detectorSettings = settings.detectorFactory.getDefaultSettings();
        settings.trackerFactory = new MemtrackTrackerFactory();
        settings.trackerSettings = settings.trackerFactory.getDefaultSettings();
        settings.trackerSettings.put("MINIMUM_TRACK_LENGTH", 30);
        settings.addAllAnalyzers();
        TrackMate trackmate = new TrackMate(settings);
        trackmate.getModel().setLogger(recorder);
        return trackmate;
    }

    private static List<Spot> spots(Model model) {
        return StreamSupport.stream(model.getSpots().iterable(false).spliterator(), false)
                .toList();
    }

    @Test
    void swimmersInWaterAreFoundTrackedSavedAndReadBack(@TempDir Path folder) {
        Recorder recorder = new Recorder();
        TrackMate trackmate = trackmate(water, recorder);
        assertThat(trackmate.checkInput()).as(trackmate.getErrorMessage()).isTrue();
        assertThat(trackmate.process()).as(trackmate.getErrorMessage()).isTrue();
        System.out.println(recorder.text);
        assertThat(recorder.text).contains("MEMTrack server: ", "Model ", " detections above ", "Detecting");

        List<Spot> spots = spots(trackmate.getModel());
        assertThat(spots.size()).isBetween(300, 3000);
        for (Spot spot : spots) {
            assertThat(spot.getDoublePosition(0)).isBetween(-10.0, 660 * MICROMETRES_PER_PIXEL + 10);
            assertThat(spot.getDoublePosition(1)).isBetween(-10.0, 492 * MICROMETRES_PER_PIXEL + 10);
            double width = spot.getFeature("MEMTRACK_BOX_WIDTH");
            double height = spot.getFeature("MEMTRACK_BOX_HEIGHT");
            assertThat(spot.getFeature(Spot.RADIUS)).isCloseTo((width + height) / 4, within(1e-9));
            if (spot.getFeature("MEMTRACK_INTERPOLATED") == 0) {
                assertThat(spot.getFeature(Spot.QUALITY)).isEqualTo(spot.getFeature("MEMTRACK_SCORE")).isBetween(0.0, 1.0);
                assertThat(spot.getFeature("MEMTRACK_LEVEL")).isBetween(1.0, 3.0);
                assertThat(spot.getFeature("MEMTRACK_CONTRAST")).isBetween(-1.0, 1.0);
                assertThat(spot.getFeature("MEMTRACK_POSITION_ERROR")).isBetween(0.0, 10 * MICROMETRES_PER_PIXEL);
            }
        }
        assertThat(trackmate.getModel().getTrackModel().nTracks(true)).isBetween(5, 60);

        File file = folder.resolve("water.xml").toFile();
        TmXmlWriter writer = new TmXmlWriter(file);
        writer.appendModel(trackmate.getModel());
        writer.appendSettings(trackmate.getSettings());
        assertThat(file).satisfies(target -> writer.writeToFile());
        TmXmlReader reader = new TmXmlReader(file);
        TrackerInTrackMateTest.assertEqual(reader.getModel(), trackmate.getModel());
        Settings read = reader.readSettings(reader.readImage());
        assertThat(reader.isReadingOk()).as(reader.getErrorMessage()).isTrue();
        assertThat(read.detectorFactory).isInstanceOf(MemtrackDetectorFactory.class);
        assertThat(read.detectorSettings).isEqualTo(trackmate.getSettings().detectorSettings);
        assertThat(read.trackerSettings).isEqualTo(trackmate.getSettings().trackerSettings);
    }

    @Test
    void frameRangeAndSelectionAreRespected() {
        Recorder recorder = new Recorder();
        TrackMate trackmate = trackmate(water, recorder);
        Roi roi = new OvalRoi(100, 50, 300, 250);
        trackmate.getSettings().setRoi(roi);
        trackmate.getSettings().tstart = 10;
        trackmate.getSettings().tend = 39;
        assertThat(trackmate.execDetection()).as(trackmate.getErrorMessage()).isTrue();
        List<Spot> spots = spots(trackmate.getModel());
        assertThat(spots).isNotEmpty();
        for (Spot spot : spots) {
            assertThat(spot.getFeature(Spot.FRAME)).isBetween(10.0, 39.0);
            assertThat(spot.getFeature(Spot.POSITION_T))
                    .isCloseTo(spot.getFeature(Spot.FRAME) / 26.87, within(1e-6));
            assertThat(roi.contains(
                            (int) Math.round(spot.getDoublePosition(0) / MICROMETRES_PER_PIXEL),
                            (int) Math.round(spot.getDoublePosition(1) / MICROMETRES_PER_PIXEL)))
                    .isTrue();
        }
        assertThat(spots.stream().map(spot -> spot.getFeature(Spot.FRAME)).distinct().count()).isGreaterThan(20);
    }

    @Test
    void nothingAboveTheThresholdIsExplained() {
        Recorder recorder = new Recorder();
        TrackMate trackmate = trackmate(water, recorder);
        trackmate.getSettings().tend = 29;
        trackmate.getSettings().detectorSettings.putAll(java.util.Map.of(
                "THRESHOLDS", "GIVEN", "THRESHOLD_LOW", 1.0, "THRESHOLD_MEDIUM", 1.0, "THRESHOLD_HIGH", 1.0));
        assertThat(trackmate.execDetection()).as(trackmate.getErrorMessage()).isTrue();
        assertThat(spots(trackmate.getModel())).isEmpty();
        assertThat(recorder.text).containsPattern("0 detections above 1.00; \\d{2,} weaker boxes").contains("lower the thresholds");
    }

    @Test
    void badSettingsAndFilmsAreRefusedWithOneSentence() {
        TrackMate trackmate = trackmate(water, new Recorder());
        trackmate.getSettings().detectorSettings.put("TARGET_CHANNEL", 3);
        assertThat(trackmate.execDetection()).isFalse();
        assertThat(trackmate.getErrorMessage()).contains("has 1 channels").contains("channel 3");
        trackmate.getSettings().detectorSettings.put("TARGET_CHANNEL", 1.0);
        assertThat(trackmate.execDetection()).isFalse();
        assertThat(trackmate.getErrorMessage()).contains("TARGET_CHANNEL", "a whole number");
        trackmate.getSettings().detectorSettings = trackmate.getSettings().detectorFactory.getDefaultSettings();
        trackmate.getSettings().detectorSettings.put("MODEL", "no-such-model");
        assertThat(trackmate.execDetection()).isFalse();
        assertThat(trackmate.getErrorMessage()).contains("no-such-model");

        ImagePlus stack = Films.twoSwimmers(5);
        stack.setDimensions(1, 5, 1);
        TrackMate onStack = trackmate(stack, new Recorder());
        assertThat(onStack.execDetection()).isFalse();
        assertThat(onStack.getErrorMessage()).contains("5 slices in Z");
        ImagePlus colour = IJ.createImage("colour film", "RGB", 20, 20, 5);
        colour.setDimensions(1, 1, 5);
        TrackMate onColour = trackmate(colour, new Recorder());
        assertThat(onColour.execDetection()).isFalse();
        assertThat(onColour.getErrorMessage()).contains("colour image");
    }

    @Test
    void cancelIsHeardWithinTwoSecondsAtEveryStage() throws Exception {
        for (long wait : new long[] {0, 400, 1000, 2000}) {
            Recorder recorder = new Recorder();
            TrackMate trackmate = trackmate(water, recorder);
            Thread run = new Thread(trackmate::execDetection);
            run.start();
            // TrackMate forgets a cancellation that comes before it knows the detector.
            while (run.isAlive() && recorder.text.indexOf("Starting the server") < 0) {
                Thread.sleep(2);
            }
            Thread.sleep(wait);
            double progress = recorder.progress;
            long start = System.nanoTime();
            trackmate.cancel("test");
            run.join(10_000);
            double seconds = (System.nanoTime() - start) / 1e9;
            System.out.printf("cancelled at %.0f %%: %.2f s%n", 100 * progress, seconds);
            assertThat(run.isAlive()).isFalse();
            assertThat(seconds).isLessThan(2);
            assertThat(trackmate.isCanceled()).isTrue();
        }
    }

    @Test
    void cancelIsHeardWithinTwoSecondsWhileFramesAreBeingSent() throws Exception {
        ImageStack stack = new ImageStack(500, 400);
        byte[] pixels = new byte[500 * 400];
        for (int frame = 0; frame < 3000; frame++) {
            stack.addSlice("", pixels);
        }
        ImagePlus film = new ImagePlus("long film", stack);
        film.setDimensions(1, 1, 3000);
        film.getCalibration().frameInterval = 0.1;
        Recorder recorder = new Recorder();
        TrackMate trackmate = trackmate(film, recorder);
        trackmate.getSettings().detectorSettings.put("CELL_LENGTH_PX", 8.0);
        Thread run = new Thread(trackmate::execDetection);
        run.start();
        while (run.isAlive() && !recorder.status.startsWith("Sending the film, frame")) {
            Thread.sleep(2);
        }
        long start = System.nanoTime();
        trackmate.cancel("test");
        run.join(10_000);
        double seconds = (System.nanoTime() - start) / 1e9;
        System.out.printf("cancelled at %s: %.2f s%n", recorder.lastWork, seconds);
        assertThat(seconds).isLessThan(2);
        assertThat(recorder.text).contains("Sending the film").doesNotContain("Background");
        assertThat(trackmate.getModel().getSpots().getNSpots(false)).isZero();
    }
}
