// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.tracking.Axis.Noise;
import org.memtrack.tracking.Matching.Pair;

class MotionAssociationTest {
    private static final ContrastModel CONTRASTS = new ContrastModel(new Noise(0.001, 0.001, 0, 0.0001, 0), 0, 0.1);
    private static final SwimmerModel SWIMMERS = new SwimmerModel(30, MotionModel.swimmers(30), CONTRASTS);

    private static Detection at(double x, double y, double contrast) {
        return new Detection(Box.around(x, y, 30, 30), 0.9, Level.HIGH, contrast, Double.NaN);
    }

    private static Tracklet begun(double x, double y, double contrast) {
        Tracklet tracklet = new Tracklet(at(x, y, contrast), SWIMMERS);
        tracklet.predict();
        return tracklet;
    }

    private static List<Integer> detectionsOf(List<Tracklet> tracklets, List<Detection> detections) {
        return new MotionAssociation(SWIMMERS)
                .match(tracklets, detections).stream()
                        .sorted((a, b) -> a.track() - b.track())
                        .map(Pair::detection)
                        .toList();
    }

    @Test
    void ofPlacesThatAreAsNearTheOneOfItsContrastIsTaken() {
        List<Tracklet> tracklets = List.of(begun(50, 50, 0.3), begun(56, 50, -0.3));

        assertThat(detectionsOf(tracklets, List.of(at(53, 47, 0.3), at(53, 53, -0.3))))
                .containsExactly(0, 1);
        assertThat(detectionsOf(tracklets, List.of(at(53, 47, -0.3), at(53, 53, 0.3))))
                .containsExactly(1, 0);
    }

    @Test
    void aPlaceOutOfReachIsNotTakenForItsContrast() {
        assertThat(detectionsOf(List.of(begun(50, 50, 0.3)), List.of(at(90, 50, 0.3))))
                .isEmpty();
    }

    /** The first one reaches one place only, which the second, in its own place, reaches too. */
    @Test
    void asManyPlacesAreTakenWhateverTheirContrasts() {
        for (double away = 0; away <= 40; away += 0.5) {
            List<Tracklet> tracklets = List.of(begun(50, 50, 0.3), begun(62 + away, 50, 0.3));
            Detection own = at(62 + away, 50, 0.3);

            assertThat(detectionsOf(tracklets, List.of(at(50 + away, 50, -0.9), own)))
                    .as("%s pixels away".formatted(away))
                    .hasSameSizeAs(detectionsOf(tracklets, List.of(at(50 + away, 50, 0.3), own)));
        }
    }

    /** Beside another, a contrast is not all its own. */
    @Test
    void whereOthersAreNearAContrastSaysLess() {
        Detection found = at(50, 50, 0.5);
        Axis alone = contrastAfter(found, at(50, 62.1, 0));
        Axis crowded = contrastAfter(found, at(50, 61.9, 0));

        assertThat(alone.value()).isGreaterThan(0.45);
        assertThat(crowded.value()).isLessThan(0.4);
        assertThat(crowded.variance()).isGreaterThan(alone.variance());
    }

    /** Of a swimmer that was seen with a contrast of 0.3 before. */
    private static Axis contrastAfter(Detection found, Detection neighbour) {
        Sort sort = new Sort(SortSettings.DEFAULTS, SWIMMERS);
        sort.step(new FrameDetections(0, List.of(at(50, 50, 0.3))));
        sort.step(new FrameDetections(1, List.of(found, neighbour)));
        sort.step(new FrameDetections(2, List.of(found, neighbour)));
        sort.step(new FrameDetections(3, List.of(found, neighbour)));
        return sort.tracklets().get(0).contrast();
    }
}
