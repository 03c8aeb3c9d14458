// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;
import org.memtrack.testing.RandomWorld;

class GapFillingTest {

    private static TrackPoint observed(int frame, double x, double y) {
        Box box = Box.around(x, y, 30, 30);
        return new TrackPoint(frame, box, new Detection(box, 0.9, Level.LOW));
    }

    @Test
    void withoutGapsNothingIsAdded() {
        List<TrackPoint> points = List.of(observed(3, 1, 2), observed(4, 2, 2));

        assertThat(GapFilling.fill(points)).isEqualTo(points);
    }

    @Test
    void aGapBetweenTwoLonelyDetectionsIsNearlyAStraightLine() {
        List<TrackPoint> filled = GapFilling.fill(List.of(observed(3, 10, 50), observed(7, 14, 42)));

        assertThat(filled).hasSize(5);
        assertThat(filled).extracting(TrackPoint::interpolated).containsExactly(false, true, true, true, false);
        assertThat(filled.get(2).box().centreX()).isCloseTo(12, within(0.3));
        assertThat(filled.get(2).box().centreY()).isCloseTo(46, within(0.6));
    }

    @Test
    void aTurnInAGapIsRounded() {
        List<TrackPoint> points = new ArrayList<>();
        for (int frame = 0; frame <= 20; frame++) {
            points.add(observed(frame, 3 * frame, 0));
        }
        for (int frame = 30; frame <= 50; frame++) {
            points.add(observed(frame, 75, 3 * (frame - 25)));
        }

        Box corner = GapFilling.fill(points).get(25).box();

        // The swimmer turned at (75, 0); the straight line would pass (67.5, 7.5).
        assertThat(Math.hypot(corner.centreX() - 75, corner.centreY())).isLessThan(7);
    }

    @Test
    void inRandomWorldsItIsNearerToTheTruthThanTheStraightLine() {
        SortSettings settings = new SortSettings(
                Association.MOTION, 0.05, 25, 0, Interpolation.FILL_GAPS, false, TrackFilter.ofLength(1));
        for (String name : List.of("collagen", "water")) {
            RandomWorld world = RandomWorld.of(TrackingBenchmark.WORLDS.get(name), 77);
            List<Track> filled = new SortTracker(settings).track(world.frames());
            List<Track> straight =
                    filled.stream().map(GapFillingTest::straightened).toList();

            double error = AssociationScore.of(world, filled).gapError();

            assertThat(error)
                    .as(name)
                    .isLessThan(AssociationScore.of(world, straight).gapError());
        }
    }

    private static Track straightened(Track track) {
        List<TrackPoint> points = new ArrayList<>(track.points());
        for (int i = 0; i < points.size(); i++) {
            if (points.get(i).interpolated()) {
                int next = i;
                while (points.get(next).interpolated()) {
                    next++;
                }
                Box from = points.get(i - 1).box();
                Box to = points.get(next).box();
                double share = 1.0 / (next - i + 1);
                Box box = Box.around(
                        from.centreX() + share * (to.centreX() - from.centreX()),
                        from.centreY() + share * (to.centreY() - from.centreY()),
                        from.width(),
                        from.height());
                points.set(i, new TrackPoint(points.get(i).frame(), box, null));
            }
        }
        return new Track(track.id(), points);
    }
}
