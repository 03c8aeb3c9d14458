// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** One-to-one matching of greatest total gain, from the pairs that are possible at all. */
final class Matching {
    private Matching() {}

    /**
     * A possible match.
     *
     * @param track index of the track
     * @param detection index of the detection
     * @param gain what matching them is worth, more than 0; to leave both alone is worth 0
     */
    record Pair(int track, int detection, double gain) {}

    /**
     * The matching of greatest total gain. Pairs that share no track and no detection, directly or through others, are
     * solved apart, so thousands of tracks that are far from each other stay fast.
     */
    static List<Pair> best(int tracks, int detections, List<Pair> possible) {
        int[] parent = new int[tracks + detections];
        Arrays.setAll(parent, i -> i);
        for (Pair pair : possible) {
            parent[root(parent, pair.track)] = root(parent, tracks + pair.detection);
        }
        Map<Integer, List<Pair>> groups = new LinkedHashMap<>();
        for (Pair pair : possible) {
            groups.computeIfAbsent(root(parent, pair.track), group -> new ArrayList<>())
                    .add(pair);
        }
        List<Pair> matched = new ArrayList<>();
        for (List<Pair> group : groups.values()) {
            matched.addAll(group.size() == 1 ? group : solve(group));
        }
        return matched;
    }

    private static int root(int[] parent, int node) {
        int current = node;
        while (parent[current] != current) {
            parent[current] = parent[parent[current]];
            current = parent[current];
        }
        return current;
    }

    private static List<Pair> solve(List<Pair> group) {
        int[] tracks = group.stream().mapToInt(Pair::track).distinct().sorted().toArray();
        int[] detections =
                group.stream().mapToInt(Pair::detection).distinct().sorted().toArray();
        boolean tall = tracks.length > detections.length;
        int[] rows = tall ? detections : tracks;
        int[] columns = tall ? tracks : detections;
        double[][] cost = new double[rows.length][columns.length];
        Pair[][] pairs = new Pair[rows.length][columns.length];
        for (Pair pair : group) {
            int row = Arrays.binarySearch(rows, tall ? pair.detection : pair.track);
            int column = Arrays.binarySearch(columns, tall ? pair.track : pair.detection);
            cost[row][column] = -pair.gain;
            pairs[row][column] = pair;
        }
        int[] columnOfRow = LinearAssignment.solve(cost);
        Collection<Pair> chosen = new ArrayList<>();
        for (int row = 0; row < rows.length; row++) {
            Pair pair = pairs[row][columnOfRow[row]];
            if (pair != null) {
                chosen.add(pair);
            }
        }
        return List.copyOf(chosen);
    }
}
