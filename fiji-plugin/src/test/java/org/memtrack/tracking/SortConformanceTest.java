// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import com.google.gson.Gson;
import com.google.gson.annotations.SerializedName;
import java.io.IOException;
import java.io.Reader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;

/** The authors' mode against an independent SORT in Python: {@code tests/conformance/make_sort.py}. */
class SortConformanceTest {

    /** A world with what SORT gives for it; boxes are x_min, y_min, x_max, y_max. */
    record World(
            String name,
            @SerializedName("iou_gate") double iouGate,
            @SerializedName("maximum_age") int maximumAge,
            @SerializedName("minimum_hits") int minimumHits,
            double[][][] frames,
            double[][] expected) {
        @Override
        public String toString() {
            return name;
        }
    }

    static Stream<World> worlds() throws IOException {
        Path file = Path.of("..", "tests", "conformance", "sort.json");
        try (Reader reader = Files.newBufferedReader(file, StandardCharsets.UTF_8)) {
            World[] worlds = new Gson().fromJson(reader, World[].class);
            assertThat(worlds).hasSize(4);
            return Arrays.stream(worlds);
        }
    }

    @ParameterizedTest
    @MethodSource("worlds")
    void authorsModeEqualsAnIndependentSort(World world) {
        List<FrameDetections> frames = new ArrayList<>();
        for (double[][] boxes : world.frames()) {
            List<Detection> detections = Arrays.stream(boxes)
                    .map(box -> new Detection(new Box(box[0], box[1], box[2], box[3]), 1, Level.LOW))
                    .toList();
            frames.add(new FrameDetections(frames.size(), detections));
        }
        SortSettings settings = new SortSettings(
                Association.OVERLAP,
                world.iouGate(),
                world.maximumAge(),
                world.minimumHits(),
                Interpolation.AUTHORS,
                false,
                TrackFilter.ofLength(1));

        List<Track> tracks = new SortTracker(settings).track(frames);

        List<TrackerOutput.Line> expected = Arrays.stream(world.expected())
                .map(row ->
                        new TrackerOutput.Line((int) row[0], (int) row[1], new Box(row[2], row[3], row[4], row[5]), 1))
                .toList();
        TrackerOutput.assertSameUpToIds(TrackerOutput.lines(tracks), expected);
    }
}
