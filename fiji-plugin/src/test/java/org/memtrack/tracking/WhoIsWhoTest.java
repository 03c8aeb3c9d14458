// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.testing.RandomWorld;

/** How well tracks keep to their swimmers in random worlds, in which it is known who is who. */
class WhoIsWhoTest {
    private static SortSettings settings(Association association, int maximumAge) {
        return new SortSettings(
                association, 0.05, maximumAge, 0, Interpolation.FILL_GAPS, false, TrackFilter.ofLength(1));
    }

    @Test
    void associationByMotionSwitchesBetweenSwimmersLessThanTheOneByOverlap() {
        RandomWorld.Settings crowd = TrackingBenchmark.WORLDS.get("crowd");
        int motion = 0;
        int overlap = 0;
        for (int seed = 100; seed < 102; seed++) {
            RandomWorld world = RandomWorld.of(crowd, seed);
            motion += switches(world, settings(Association.MOTION, 25));
            overlap += switches(world, settings(Association.OVERLAP, 25));
        }

        assertThat(motion).isLessThan((int) (0.85 * overlap));
    }

    /** In these two worlds swimmers that meet are confused when they are joined frame by frame. */
    @ParameterizedTest
    @ValueSource(longs = {8, 153})
    void whoMeetsIsToldByBothSidesOfTheMeeting(long seed) {
        RandomWorld world =
                RandomWorld.of(new RandomWorld.Settings(200, 150, 80, 6, 2, 0.02, 30, 0.5, 0.05, 0, 0.1, 0), seed);

        assertThat(switches(world, SortSettings.WATER.with(TrackFilter.ofLength(1))))
                .isZero();
    }

    @Test
    void swimmersFasterThanUsualAreJoinedOnceTheirSpeedIsKnown() {
        RandomWorld.Settings fewFrames = TrackingBenchmark.WORLDS.get("few frames");
        for (int seed = 0; seed < 3; seed++) {
            RandomWorld world = RandomWorld.of(fewFrames, seed);

            List<Track> tracks = new SortTracker(settings(Association.MOTION, 5)).track(world.frames());

            assertThat(AssociationScore.of(world, tracks).association()).isGreaterThan(0.45);
        }
    }

    private static int switches(RandomWorld world, SortSettings settings) {
        return AssociationScore.of(world, new SortTracker(settings).track(world.frames()))
                .switches();
    }
}
