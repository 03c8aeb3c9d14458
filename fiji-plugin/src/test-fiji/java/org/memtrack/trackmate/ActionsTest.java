// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import fiji.plugin.trackmate.Logger;
import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.providers.ActionProvider;
import ij.IJ;
import ij.ImagePlus;
import ij.ImageStack;
import ij.VirtualStack;
import ij.gui.Plot;
import ij.measure.Calibration;
import ij.measure.ResultsTable;
import ij.process.ImageProcessor;
import java.awt.event.KeyEvent;
import java.io.IOException;
import java.lang.ref.WeakReference;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import java.util.function.IntFunction;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.client.Progress;
import org.memtrack.detection.DetectorException;
import org.memtrack.formats.TrackCsv;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;
import org.memtrack.video.ImageFilm;

class ActionsTest {
    private static TrackMate tracked() {
        TrackMate trackmate = TrackerInTrackMateTest.logAndSort(Films.twoSwimmers(20), 4 * Films.PIXEL_SIZE, 20, 10);
        assertThat(trackmate.process()).as(trackmate.getErrorMessage()).isTrue();
        return trackmate;
    }

    @Test
    void trackMateFindsTheActions() {
        assertThat(new ActionProvider().getVisibleKeys())
                .contains("MEMTRACK_MOTILITY", "MEMTRACK_EVALUATION", "MEMTRACK_TRAINING_DATA");
        assertThat(new ActionProvider().getFactory("MEMTRACK_MOTILITY").create()).isInstanceOf(MotilityAction.class);
    }

    @Test
    void tracksOfTheModelAreInPixelsWithTheirGapsMarked() {
        ModelTracks tracks = ModelTracks.of(tracked());
        assertThat(tracks.names()).containsExactlyInAnyOrder("Track_0", "Track_1");
        TrackPoint point = tracks.tracked().tracks().stream()
                .flatMap(track -> track.points().stream())
                .filter(candidate -> candidate.frame() == 9 && candidate.interpolated())
                .findFirst()
                .orElseThrow();
        assertThat(point.box().centreX()).isCloseTo(12 + 2 * 9, within(0.3));
        assertThat(point.box().width()).isCloseTo(8, within(1e-6));
        assertThat(tracks.tracked().tracks()).allSatisfy(track -> assertThat(track.length()).isEqualTo(20));
    }

    @Test
    void theTableHasTheSpeedOfEachTrack() {
        ResultsTable table = MotilityAction.table(ModelTracks.of(tracked()));
        assertThat(table.size()).isEqualTo(2);
        for (int row = 0; row < 2; row++) {
            assertThat(table.getValue("Speed (px/frame)", row)).isCloseTo(2, within(0.05));
            assertThat(table.getValue("Speed (um/s)", row))
                    .isCloseTo(2 * Films.PIXEL_SIZE / Films.INTERVAL, within(0.03));
        }
        assertThat(table.getValue("Interpolated", 0) + table.getValue("Interpolated", 1)).isEqualTo(3);
        assertThat(MotilityAction.speeds(ModelTracks.of(tracked())).getSize().width).isPositive();
        assertThat(MotilityAction.speeds(ModelTracks.of(tracked())).getLabel('x'))
                .as("one frame is the least lag")
                .isEqualTo("speed over 0.5 s (um/s)");
        Plot classes = MotilityAction.classes(ModelTracks.of(tracked()));
        assertThat(classes.getLabel('x')).isEqualTo("{none,low,medium,high}");
        assertThat(classes.getPlotObjectStyle(0)).contains("Separated Bars");
    }

    @Test
    void withoutCalibrationSpeedsOverTheLagArePixelsAFrame() {
        ImagePlus film = Films.twoSwimmers(20);
        film.setCalibration(new Calibration());
        TrackMate trackmate = TrackerInTrackMateTest.logAndSort(film, 4, 20, 10);
        assertThat(trackmate.process()).as(trackmate.getErrorMessage()).isTrue();
        ModelTracks tracks = ModelTracks.of(trackmate);
        ResultsTable table = MotilityAction.table(tracks);
        assertThat(table.getValue("Lag speed (px/frame)", 0)).isCloseTo(2, within(0.05));
        assertThat(table.getValue("Speed (um/s)", 0)).isNaN();
        assertThat(MotilityAction.speeds(tracks).getLabel('x')).isEqualTo("speed over 6 frames (px/frame)");
        assertThat(tracks.notes()).singleElement().asString().contains("set what is missing in Image > Properties");
    }

    @Test
    void trainingDataHoldsTheFilmTheTracksAndTheRecipeLines(@TempDir Path folder) throws Exception {
        List<Path> files = TrainingDataAction.export(ModelTracks.of(tracked()), folder);
        assertThat(files).extracting(file -> file.getFileName().toString())
                .containsExactly("two_swimmers.tif", "two_swimmers.csv", "two_swimmers.toml");
        ImagePlus film = IJ.openImage(files.get(0).toString());
        assertThat(film.getNFrames()).isEqualTo(20);
        assertThat(film.getCalibration().pixelWidth).isCloseTo(Films.PIXEL_SIZE, within(1e-6));
        assertThat(film.getStack().getProcessor(5).getPixels())
                .isEqualTo(Films.twoSwimmers(20).getStack().getProcessor(5).getPixels());
        assertThat(Files.readAllLines(files.get(1)))
                .hasSize(1 + 2 * 20)
                .filteredOn(row -> row.matches("[01],(8|9|10),.*,,,1,.*"))
                .as("interpolated rows have neither score nor level")
                .hasSize(3);
        assertThat(Files.readString(files.get(2)))
                .contains("[[annotated]]", "film = \"two_swimmers.tif\"", "tracks = \"two_swimmers.csv\"")
                .contains("pixel_size_um = 0.25", "frame_interval_seconds = 0.5");

        assertThatThrownBy(() -> TrainingDataAction.export(ModelTracks.of(tracked()), folder))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("is there already");
        try (var left = Files.list(folder)) {
            assertThat(left).hasSize(3);
        }
    }

    @Test
    void aFilmOnDiskIsExportedFrameByFrame(@TempDir Path folder) throws Exception {
        ImageStack frames = Films.twoSwimmers(20).getStack();
        List<WeakReference<Object>> read = new ArrayList<>();
        ModelTracks tracks = onDisk(slice -> {
            System.gc();
            assertThat(read.stream().filter(pixels -> pixels.get() != null).count())
                    .as("frames in memory when slice %d is read", slice)
                    .isLessThan(5);
            ImageProcessor frame = frames.getProcessor(slice).convertToShort(false);
            read.add(new WeakReference<>(frame.getPixels()));
            return frame;
        });
        ImagePlus film =
                IJ.openImage(TrainingDataAction.export(tracks, folder).get(0).toString());
        assertThat(read).hasSizeGreaterThanOrEqualTo(20);
        assertThat(film.getNFrames()).isEqualTo(20);
        for (int slice = 1; slice <= 20; slice++) {
            assertThat(film.getStack().getPixels(slice))
                    .isEqualTo(frames.getProcessor(slice).convertToShort(false).getPixels());
        }
    }

    @Test
    void aFrameThatCannotBeReadIsOneSentence(@TempDir Path folder) throws Exception {
        ImageStack frames = Films.twoSwimmers(20).getStack();
        ModelTracks tracks = onDisk(slice -> slice == 7 ? null : frames.getProcessor(slice));
        assertThatThrownBy(() -> TrainingDataAction.export(tracks, folder))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("Slice 7 of \"two swimmers\" cannot be read");
        try (var left = Files.list(folder)) {
            assertThat(left).isEmpty();
        }
    }

    /** The tracks of the two swimmers, whose slices are read each time they are wanted. */
    private static ModelTracks onDisk(IntFunction<ImageProcessor> slices) {
        ImagePlus film = new ImagePlus("two swimmers", new VirtualStack(100, 80, 20) {
            @Override
            public ImageProcessor getProcessor(int slice) {
                return slices.apply(slice);
            }
        });
        film.setDimensions(1, 1, 20);
        ModelTracks inMemory = ModelTracks.of(tracked());
        FilmOptions options = new FilmOptions(FrameAxis.T, 1, 1, 0, OptionalDouble.empty(), OptionalDouble.empty());
        return new ModelTracks(
                inMemory.tracked(),
                new ImageFilm(film, options),
                inMemory.names(),
                inMemory.measured(),
                inMemory.notes());
    }

    @Test
    void aFolderForTrainingDataIsMadeWhereItCanBe(@TempDir Path folder) throws Exception {
        Path made = folder.resolve("Jörg").resolve("new");
        assertThat(TrainingDataAction.export(ModelTracks.of(tracked()), made)).hasSize(3);
        assertThat(made.resolve("two_swimmers.toml")).exists();

        Path file = Files.createFile(folder.resolve("file"));
        assertThatThrownBy(() -> TrainingDataAction.export(ModelTracks.of(tracked()), file))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("cannot be made: choose another one");
    }

    @Test
    void tracksComparedWithThemselvesAreRight(@TempDir Path folder) throws Exception {
        ModelTracks tracks = ModelTracks.of(tracked());
        Path truth = folder.resolve("truth with space ü.csv");
        tracks.write(truth);
        List<String> lines = EvaluationAction.evaluate(tracks, truth, folder.resolve("out"), Progress.NONE);
        assertThat(lines)
                .contains(
                        "Boxes, frame by frame: precision 1.000, recall 1.000, F1 1.000; 1 is best.",
                        "Tracks in the truth: 2. Compared with it: 2, of which 0 false, with fewer than half of their points right.");
        assertThat(folder.resolve("out/evaluation.html")).exists();
        assertThat(Files.readString(folder.resolve("out/evaluation.json"))).contains("\"f1\": 1.0");
    }

    @Test
    void theRadiusOfAnotherDetectorIsNoSizeToCompareOrTrainBy(@TempDir Path folder) throws Exception {
        ModelTracks tracks = ModelTracks.of(tracked());
        Path truth = folder.resolve("truth.csv");
        TrackCsv.write(truth, tracks.tracked());
        // As the paper's annotators did, squares of 30 px; the spots' radius is 4 px.
        Files.writeString(truth, Files.readString(truth).replace(",8.0000,8.0000,", ",30.0000,30.0000,"));
        assertThat(Files.readString(truth)).contains(",30.0000,30.0000,");

        assertThat(EvaluationAction.evaluate(tracks, truth, folder.resolve("out"), Progress.NONE))
                .contains("Boxes, frame by frame: precision 1.000, recall 1.000, F1 1.000; 1 is best.");
        Path table = TrainingDataAction.export(tracks, folder.resolve("training")).get(1);
        assertThat(Files.readAllLines(table)).hasSize(1 + 2 * 20).doesNotContainSequence("8.0000,8.0000");
        assertThat(Files.readAllLines(table).subList(1, 41)).allMatch(row -> row.split(",", -1)[7].isEmpty());
    }

    @Test
    void boxesOfMemtrackAreWrittenAndThoseOfHandMadeSpotsAreNot(@TempDir Path folder) throws Exception {
        TrackMate trackmate = tracked();
        for (Spot spot : trackmate.getModel().getSpots().iterable(true)) {
            if (spot.getFeature(Spot.FRAME) != 5) {
                spot.putFeature("MEMTRACK_BOX_WIDTH", 6.0);
                spot.putFeature("MEMTRACK_BOX_HEIGHT", 5.0);
            }
        }
        Path table = folder.resolve("tracks.csv");
        ModelTracks.of(trackmate).write(table);
        assertThat(Files.readAllLines(table))
                .filteredOn(row -> row.contains(",24.0000,20.0000,"))
                .hasSize(2 * 19);
        assertThat(Files.readAllLines(table))
                .filteredOn(row -> row.matches("[01],5,.*"))
                .hasSize(2)
                .allMatch(row -> row.split(",", -1)[7].isEmpty() && row.split(",", -1)[8].isEmpty());
    }

    @Test
    void escapeStopsAComparison(@TempDir Path folder) throws Exception {
        ModelTracks tracks = ModelTracks.of(tracked());
        Path truth = folder.resolve("truth.csv");
        TrackCsv.write(truth, tracks.tracked());
        EvaluationAction action = new EvaluationAction();
        action.setLogger(new Logger.StringBuilderLogger());
        Thread user = new Thread(() -> {
            while (!Thread.interrupted()) {
                IJ.setKeyDown(KeyEvent.VK_ESCAPE);
                Thread.yield();
            }
        });
        user.start();
        try {
            assertThatThrownBy(() -> action.compare(tracks, truth)).isInstanceOf(CancellationException.class);
        } finally {
            user.interrupt();
            user.join();
            IJ.resetEscape();
        }
        assertThat(folder.resolve("truth.csv evaluation")).doesNotExist();
    }

    @Test
    void aMissingTruthIsOneSentence(@TempDir Path folder) {
        ModelTracks tracks = ModelTracks.of(tracked());
        assertThatThrownBy(() -> EvaluationAction.evaluate(
                        tracks, folder.resolve("none.mdf"), folder.resolve("out"), Progress.NONE))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("none.mdf")
                .hasMessageNotContaining("Traceback");
    }

    @Test
    void aTrackThatSplitsIsLeftOutAndNamed() {
        TrackMate trackmate = tracked();
        Model model = trackmate.getModel();
        Spot parent = model.getSpots().iterable(5, true).iterator().next();
        model.beginUpdate();
        try {
            Spot child = model.addSpotTo(new Spot(1, 1, 0, 1, 1), 6);
            model.addEdge(parent, child, 1);
        } finally {
            model.endUpdate();
        }
        ModelTracks tracks = ModelTracks.of(trackmate);
        assertThat(tracks.names()).hasSize(1);
        assertThat(tracks.notes()).anySatisfy(note -> assertThat(note).contains("split or merge: Track_"));
    }

    @Test
    void noTracksIsOneSentence() {
        TrackMate trackmate = tracked();
        trackmate.getModel().clearTracks(true);
        assertThatThrownBy(() -> ModelTracks.of(trackmate)).hasMessageContaining("no visible track");
    }
}
