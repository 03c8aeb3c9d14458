// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;

class ContrastModelTest {
    private static final double ERROR = 0.02;
    private static final double CHANGE = 0.005;

    /** Swimmers of different contrasts, which are measured with an error and change a little from frame to frame. */
    private static List<Tracklet> tracklets(int frames, double... contrasts) {
        Random random = new Random(1);
        SortSettings settings = SortSettings.DEFAULTS;
        Sort sort = new Sort(settings, SwimmerModel.usual(30));
        double[] now = contrasts.clone();
        for (int frame = 0; frame < frames; frame++) {
            List<Detection> detections = new ArrayList<>();
            for (int i = 0; i < now.length; i++) {
                now[i] += CHANGE * random.nextGaussian();
                double measured = now[i] + ERROR * random.nextGaussian();
                detections.add(
                        new Detection(Box.around(100 * i, frame, 30, 30), 0.9, Level.HIGH, measured, Double.NaN));
            }
            sort.step(new FrameDetections(frame, detections));
        }
        return sort.tracklets();
    }

    @Test
    void noiseAndSpreadOfTheFilmAreMeasured() {
        ContrastModel model = ContrastModel.of(tracklets(400, -0.5, -0.3, 0.1, 0.3));

        // Twice what is typical, for those that change more.
        assertThat(model.noise().measurement()).isCloseTo(2 * ERROR * ERROR, within(0.2 * ERROR * ERROR));
        assertThat(model.noise().step()).isCloseTo(2 * CHANGE * CHANGE, within(1.5 * CHANGE * CHANGE));
        assertThat(Math.sqrt(model.variance())).isBetween(0.2, 0.5);
    }

    @Test
    void aSwimmersOwnContrastSpeaksForItAndAnothersAgainstIt() {
        ContrastModel model = ContrastModel.of(tracklets(400, -0.5, -0.3, 0.1, 0.3));
        Axis known = Axis.start(-0.3, model.noise());

        assertThat(model.gain(known, -0.3)).isBetween(0.5, 3.0);
        assertThat(model.gain(known, 0.3)).isCloseTo(Math.log(0.1), within(0.01));
        assertThat(model.gain(known, -0.3)).isGreaterThan(model.gain(known, -0.2));
    }

    @Test
    void withoutContrastsOrWithTooFewNothingIsKnown() {
        assertThat(ContrastModel.of(tracklets(40, Double.NaN, 0.2))).isNull();
        assertThat(ContrastModel.of(tracklets(12, 0.1, 0.2))).isNull();
        assertThat(ContrastModel.of(tracklets(40, 0.1, 0.2))).isNotNull();
        assertThat(ContrastModel.of(List.of())).isNull();
    }
}
