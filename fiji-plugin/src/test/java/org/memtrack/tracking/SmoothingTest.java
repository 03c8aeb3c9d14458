// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;

/** Places that are unsure, smoothed along one track and by the tracker. */
class SmoothingTest {

    @Test
    void anUnsureDetectionIsBroughtToTheWayOfTheOthersAndASureOneStays() {
        List<TrackPoint> points = new ArrayList<>();
        for (int frame = 0; frame <= 20; frame++) {
            boolean unsure = frame == 10;
            points.add(observed(frame, 2 * frame, unsure ? 3 : 0, unsure ? 4 : 0.05));
        }
        points.remove(5);

        List<TrackPoint> smooth = Smoothing.smooth(GapFilling.fill(points));

        assertThat(smooth).hasSize(21);
        assertThat(smooth).extracting(TrackPoint::detection).containsExactlyElementsOf(detections(points, 5));
        assertThat(smooth.get(10).box().centreY()).isBetween(0.0, 1.0);
        assertThat(smooth.get(10).box().width()).isCloseTo(30, within(1e-9));
        for (int frame : List.of(0, 3, 5, 9, 11, 20)) {
            assertThat(smooth.get(frame).box().distance(Box.around(2 * frame, 0, 30, 30)))
                    .as("frame %d", frame)
                    .isLessThan(0.1);
        }
        List<TrackPoint> again = Smoothing.smooth(smooth);
        assertThat(IntStream.range(0, 21)
                        .mapToDouble(
                                i -> again.get(i).box().distance(smooth.get(i).box())))
                .allMatch(moved -> moved < 1e-9);
    }

    @Test
    void aTrackWhoseErrorsAreNotKnownStays() {
        List<TrackPoint> points = IntStream.range(0, 9)
                .mapToObj(i -> observed(i, i, i % 2, i == 4 ? Double.NaN : 0.5))
                .toList();

        assertThat(Smoothing.smooth(points)).isEqualTo(points);
    }

    @Test
    void smoothedPlacesAreNearerToTheTruthAndKeepTheSpeed() {
        Random random = new Random(5);
        double before = 0;
        double after = 0;
        double way = 0;
        double truth = 0;
        for (int swimmer = 0; swimmer < 40; swimmer++) {
            List<TrackPoint> points = new ArrayList<>();
            double[][] places = new double[80][2];
            double heading = 0;
            for (int frame = 1; frame < 80; frame++) {
                heading = random.nextDouble() < 0.05 ? random.nextDouble(2 * Math.PI) : heading;
                places[frame][0] = places[frame - 1][0] + 1.5 * Math.cos(heading);
                places[frame][1] = places[frame - 1][1] + 1.5 * Math.sin(heading);
            }
            for (int frame = 0; frame < 80; frame++) {
                double error = random.nextDouble(0.1, 2);
                // As much of it as differs from frame to frame.
                points.add(observed(
                        frame,
                        places[frame][0] + 0.3 * error * random.nextGaussian(),
                        places[frame][1] + 0.3 * error * random.nextGaussian(),
                        error));
            }
            List<TrackPoint> smooth = Smoothing.smooth(GapFilling.fill(points));
            for (int frame = 0; frame < 80; frame++) {
                Box place = Box.around(places[frame][0], places[frame][1], 30, 30);
                before += Math.pow(points.get(frame).box().distance(place), 2);
                after += Math.pow(smooth.get(frame).box().distance(place), 2);
                if (frame > 0) {
                    way += smooth.get(frame)
                            .box()
                            .distance(smooth.get(frame - 1).box());
                    truth += 1.5;
                }
            }
        }
        assertThat(Math.sqrt(after / before)).isLessThan(0.75);
        assertThat(way / truth).isBetween(0.97, 1.05);
    }

    @Test
    void unsurePlacesAreSmoothedInTheSceneUnlessTheUserWantsThemAsFound() {
        List<FrameDetections> frames = new ArrayList<>();
        Random random = new Random(3);
        for (int frame = 0; frame < 60; frame++) {
            // The stage shakes by pixels, the swimmer goes straight on.
            double drift = 5 * random.nextGaussian();
            double error = 0.3 * random.nextGaussian();
            Box box = Box.around(40 + frame + drift + error, 50, 30, 30);
            frames.add(new FrameDetections(
                    frame, List.of(new Detection(box, 0.9, Level.HIGH, Double.NaN, 1)), drift, 0, List.of()));
        }
        SortSettings settings = SortSettings.COLLAGEN.with(TrackFilter.ofLength(1));
        SortSettings asFound = new SortSettings(
                Association.MOTION, 0.05, 25, 0, Interpolation.FILL_GAPS, false, TrackFilter.ofLength(1));

        Track smooth = new SortTracker(settings).track(frames).get(0);
        Track found = new SortTracker(asFound).track(frames).get(0);

        assertThat(smooth.points()).hasSize(60);
        assertThat(errors(smooth, frames)).isLessThan(0.6 * errors(found, frames));
        for (int frame = 0; frame < 60; frame++) {
            Detection detection = frames.get(frame).detections().get(0);
            assertThat(smooth.points().get(frame).detection()).isSameAs(detection);
            assertThat(found.points().get(frame).box()).isEqualTo(detection.box());
        }
    }

    /** Root mean square distance of the swimmer above from where it is. */
    private static double errors(Track track, List<FrameDetections> frames) {
        return Math.sqrt(track.points().stream()
                .mapToDouble(point -> point.box().centreX()
                        - 40
                        - point.frame()
                        - frames.get(point.frame()).driftX())
                .map(error -> error * error)
                .average()
                .orElseThrow());
    }

    private static TrackPoint observed(int frame, double x, double y, double error) {
        Box box = Box.around(x, y, 30, 30);
        return new TrackPoint(frame, box, new Detection(box, 0.9, Level.LOW, Double.NaN, error));
    }

    /** Those of the points, null where one frame is left out. */
    private static List<Detection> detections(List<TrackPoint> points, int left) {
        List<Detection> detections =
                new ArrayList<>(points.stream().map(TrackPoint::detection).toList());
        detections.add(left, null);
        return detections;
    }
}
