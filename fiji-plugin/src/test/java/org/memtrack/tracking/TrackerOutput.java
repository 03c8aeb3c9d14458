// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;

/** Boxes with the numbers of their tracks, as trackers' output files in the form of MOTChallenge hold them. */
final class TrackerOutput {
    private TrackerOutput() {}

    /** A line of such a file: {@code frame from 1, id, left, top, width, height, score, ...}. */
    record Line(int frame, int id, Box box, double score) {}

    static List<Line> read(Path file) throws IOException {
        List<Line> lines = new ArrayList<>();
        for (String line : Files.readAllLines(file)) {
            String[] cells = line.split(",");
            double left = Double.parseDouble(cells[2]);
            double top = Double.parseDouble(cells[3]);
            Box box = new Box(left, top, left + Double.parseDouble(cells[4]), top + Double.parseDouble(cells[5]));
            int frame = (int) Double.parseDouble(cells[0]) - 1;
            lines.add(new Line(frame, (int) Double.parseDouble(cells[1]), box, Double.parseDouble(cells[6])));
        }
        assertThat(lines).as(file.toString()).isNotEmpty();
        return lines;
    }

    static List<FrameDetections> detections(List<Line> lines) {
        Map<Integer, List<Detection>> frames = new TreeMap<>();
        for (Line line : lines) {
            frames.computeIfAbsent(line.frame, frame -> new ArrayList<>())
                    .add(new Detection(line.box, line.score, Level.UNSPECIFIED));
        }
        return frames.entrySet().stream()
                .map(entry -> new FrameDetections(entry.getKey(), entry.getValue()))
                .toList();
    }

    static List<Line> lines(List<Track> tracks) {
        return tracks.stream()
                .flatMap(track ->
                        track.points().stream().map(point -> new Line(point.frame(), track.id(), point.box(), 1)))
                .toList();
    }

    /** That both hold the same boxes in the same frames, to 1e-3 px, up to a one-to-one renaming of the ids. */
    static void assertSameUpToIds(List<Line> actual, List<Line> expected) {
        assertThat(actual).hasSameSizeAs(expected);
        Map<Integer, List<Line>> rest = new HashMap<>();
        actual.forEach(line ->
                rest.computeIfAbsent(line.frame, frame -> new ArrayList<>()).add(line));
        Map<Integer, Integer> idOf = new HashMap<>();
        Map<Integer, Integer> idBack = new HashMap<>();
        for (Line line : expected) {
            List<Line> same = rest.getOrDefault(line.frame, List.of()).stream()
                    .filter(other -> isNear(line.box, other.box))
                    .toList();
            // Two tracks may hold the same box in a frame; then the one with the same id is meant.
            Line match = same.stream()
                    .filter(other -> idOf.getOrDefault(line.id, other.id) == other.id
                            && idBack.getOrDefault(other.id, line.id) == line.id)
                    .findFirst()
                    .orElseThrow(() -> new AssertionError("No match for %s among %s".formatted(line, same)));
            idOf.put(line.id, match.id);
            idBack.put(match.id, line.id);
            rest.get(line.frame).remove(match);
        }
    }

    private static boolean isNear(Box a, Box b) {
        return Math.abs(a.xMin() - b.xMin()) <= 1e-3
                && Math.abs(a.yMin() - b.yMin()) <= 1e-3
                && Math.abs(a.xMax() - b.xMax()) <= 1e-3
                && Math.abs(a.yMax() - b.yMax()) <= 1e-3;
    }
}
