// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.memtrack.tracking.Matching.Pair;

class MatchingTest {

    @Test
    void nothingPossibleMatchesNothing() {
        assertThat(Matching.best(3, 2, List.of())).isEmpty();
    }

    @Test
    void aTrackStaysAloneWhenThatIsWorthMore() {
        List<Pair> possible = List.of(new Pair(0, 0, 5), new Pair(1, 0, 2), new Pair(0, 1, 1));

        assertThat(Matching.best(2, 2, possible)).containsExactly(new Pair(0, 0, 5));
    }

    @Test
    void randomMatchingsAreAsGoodAsByTryingAll() {
        Random random = new Random(3);
        for (int world = 0; world < 300; world++) {
            int tracks = 1 + random.nextInt(6);
            int detections = 1 + random.nextInt(6);
            List<Pair> possible = new ArrayList<>();
            for (int track = 0; track < tracks; track++) {
                for (int detection = 0; detection < detections; detection++) {
                    if (random.nextDouble() < 0.35) {
                        possible.add(new Pair(track, detection, random.nextDouble(0.1, 1)));
                    }
                }
            }

            List<Pair> best = Matching.best(tracks, detections, possible);

            assertThat(possible).containsAll(best);
            assertThat(best.stream().map(Pair::track)).doesNotHaveDuplicates();
            assertThat(best.stream().map(Pair::detection)).doesNotHaveDuplicates();
            assertThat(best.stream().mapToDouble(Pair::gain).sum())
                    .isCloseTo(greatestGain(possible, 0, 0, 0), within(1e-9));
        }
    }

    private static double greatestGain(List<Pair> possible, int next, int tracks, int detections) {
        if (next == possible.size()) {
            return 0;
        }
        Pair pair = possible.get(next);
        double without = greatestGain(possible, next + 1, tracks, detections);
        int track = 1 << pair.track();
        int detection = 1 << pair.detection();
        if ((tracks & track) != 0 || (detections & detection) != 0) {
            return without;
        }
        return Math.max(
                without, pair.gain() + greatestGain(possible, next + 1, tracks | track, detections | detection));
    }
}
