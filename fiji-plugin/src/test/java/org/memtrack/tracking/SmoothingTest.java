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
import org.memtrack.detection.Level;

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
