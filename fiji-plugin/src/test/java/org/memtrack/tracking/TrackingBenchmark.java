// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.memtrack.testing.RandomWorld;

/** Prints how well and how fast each association tracks random worlds; run it by hand. */
final class TrackingBenchmark {
    static final Map<String, RandomWorld.Settings> WORLDS = new LinkedHashMap<>();

    static {
        //                                            size      frames n  speed tumble box jit miss leave return false
        WORLDS.put("collagen", new RandomWorld.Settings(660, 492, 300, 30, 0.6, 0.02, 30, 1, 0.2, 0.03, 0.10, 3));
        WORLDS.put("water", new RandomWorld.Settings(660, 492, 300, 25, 2.3, 0.02, 30, 1, 0.1, 0.01, 0.05, 2));
        WORLDS.put("crowd", new RandomWorld.Settings(660, 492, 300, 120, 1.5, 0.02, 30, 1, 0.15, 0.02, 0.10, 5));
        WORLDS.put("sprinters", new RandomWorld.Settings(660, 492, 300, 40, 6, 0.05, 30, 1, 0.1, 0.01, 0.10, 3));
        WORLDS.put("few frames", new RandomWorld.Settings(660, 492, 100, 15, 14, 0.05, 30, 1, 0.1, 0.01, 0.10, 1));
        WORLDS.put("small spots", new RandomWorld.Settings(660, 492, 300, 60, 3, 0.03, 8, 0.5, 0.1, 0.02, 0.10, 3));
    }

    /** Worlds of thousands of swimmers, for the time alone. */
    static final Map<String, RandomWorld.Settings> LARGE = new LinkedHashMap<>();

    static {
        LARGE.put("2000, apart", new RandomWorld.Settings(4000, 4000, 30, 2000, 2, 0.02, 30, 1, 0.1, 0.02, 0.1, 20));
        LARGE.put("1000, packed", new RandomWorld.Settings(660, 492, 30, 1000, 2, 0.02, 30, 1, 0.1, 0.02, 0.1, 20));
    }

    private TrackingBenchmark() {}

    public static void main(String[] args) {
        System.out.printf("%-12s %-10s %9s %8s %9s %8s%n", "world", "", "switches", "AssA", "gap error", "ms");
        WORLDS.forEach((name, world) -> report(name, world, 10));
        LARGE.forEach((name, world) -> report(name, world, 1));
    }

    private static void report(String name, RandomWorld.Settings world, int seeds) {
        for (Association association : Association.values()) {
            report(name, world, association, seeds);
        }
    }

    private static void report(String name, RandomWorld.Settings settingsOfWorld, Association association, int seeds) {
        SortSettings settings =
                new SortSettings(association, 0.05, 25, 0, Interpolation.FILL_GAPS, false, TrackFilter.ofLength(1));
        int switches = 0;
        double accuracy = 0;
        double squares = 0;
        int points = 0;
        long nanos = 0;
        for (int seed = 0; seed < seeds; seed++) {
            RandomWorld world = RandomWorld.of(settingsOfWorld, seed);
            long start = System.nanoTime();
            List<Track> tracks = new SortTracker(settings).track(world.frames());
            nanos += System.nanoTime() - start;
            AssociationScore score = AssociationScore.of(world, tracks);
            switches += score.switches();
            accuracy += score.association() / seeds;
            if (score.interpolated() > 0) {
                squares += score.gapError() * score.gapError() * score.interpolated();
                points += score.interpolated();
            }
        }
        System.out.printf(
                "%-12s %-10s %9.1f %8.3f %9.2f %8.1f%n",
                name,
                association,
                switches / (double) seeds,
                accuracy,
                Math.sqrt(squares / points),
                nanos / 1e6 / seeds);
    }
}
