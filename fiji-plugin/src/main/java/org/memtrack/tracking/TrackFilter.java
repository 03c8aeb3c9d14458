// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;
import java.util.OptionalDouble;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.Level;

/**
 * Which tracks are kept: those that are long enough (paper section "Track Length Filter") and whose detector was sure
 * enough, all in all.
 *
 * <p>A static look-alike that flickers is found now and then, and interpolation makes a long track of it: so a frame in
 * which nothing was found counts against a track. A swimmer that crosses the edge of the field, or is clear to see until
 * it leaves the focal plane, makes a short track; false ones are hardly ever at the edge or of a high score: so a track
 * that is sure to be real, by its place or its score, may be short.
 *
 * @param minimumLength frames a track must span, interpolated ones included, at least 1
 * @param minimumLengthIfSure the same for a track that is sure to be real: one that begins or ends at the edge of the
 *     field, or whose mean score is at least {@link #SURE_SCORE}
 * @param minimumScore least mean score of the track's frames, in [0, 1], a frame without a detection counting as 0; scores
 *     of other detectors ({@link Level#UNSPECIFIED}) are no probabilities and are not asked
 */
public record TrackFilter(int minimumLength, int minimumLengthIfSure, double minimumScore) {
    /** Mean score from which a track is sure to be real; chosen, as the least one, on simulated films of their own. */
    public static final double SURE_SCORE = 0.9;

    /** What the models' calibrated scores are asked for. */
    private static final double LEAST_SCORE = 0.3;

    public TrackFilter {
        requireLength("track length", minimumLength);
        requireLength("length of sure tracks", minimumLengthIfSure);
        if (!(minimumScore >= 0 && minimumScore <= 1)) {
            throw new IllegalArgumentException("The minimum track score must lie in 0 to 1, not " + minimumScore);
        }
    }

    /** The paper's filter: length alone, anywhere. */
    public static TrackFilter ofLength(int frames) {
        return new TrackFilter(frames, frames, 0);
    }

    /** Ours: a quarter of the length is enough when a track is sure to be real, and the score is asked of all. */
    public static TrackFilter ofSwimmers(int frames) {
        return new TrackFilter(frames, (frames + 3) / 4, LEAST_SCORE);
    }

    /**
     * Whether a track is kept.
     *
     * @param points of the track, at least one
     * @param field where the film looks; null when not known
     */
    public boolean keeps(List<TrackPoint> points, @Nullable Field field) {
        TrackPoint first = points.get(0);
        TrackPoint last = points.get(points.size() - 1);
        int length = length(points);
        OptionalDouble score = meanScore(points, length);
        boolean atEdge = field != null && (field.isAtEdge(first.box()) || field.isAtEdge(last.box()));
        boolean sure = atEdge || score.orElse(0) >= SURE_SCORE;
        return length >= (sure ? Math.min(minimumLengthIfSure, minimumLength) : minimumLength)
                && score.orElse(1) >= minimumScore;
    }

    /** Whether a track is as long as one must be that is not sure to be real; of at least one point. */
    boolean isLong(List<TrackPoint> points) {
        return length(points) >= minimumLength;
    }

    private static int length(List<TrackPoint> points) {
        return points.get(points.size() - 1).frame() - points.get(0).frame() + 1;
    }

    /** A frame without a detection counts as 0; empty when the scores are no probabilities. */
    private static OptionalDouble meanScore(List<TrackPoint> points, int length) {
        double sum = 0;
        for (TrackPoint point : points) {
            if (point.detection() != null) {
                if (point.detection().level() == Level.UNSPECIFIED) {
                    return OptionalDouble.empty();
                }
                sum += point.detection().score();
            }
        }
        return OptionalDouble.of(sum / length);
    }

    private static void requireLength(String name, int frames) {
        if (frames < 1) {
            throw new IllegalArgumentException("The minimum %s must be at least 1, not %d".formatted(name, frames));
        }
    }
}
