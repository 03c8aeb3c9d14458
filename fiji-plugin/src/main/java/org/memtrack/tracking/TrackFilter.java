// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.Level;

/**
 * Which tracks are kept: those that are long enough (paper section "Track Length Filter") and whose detector was sure
 * enough, all in all.
 *
 * <p>A static look-alike that flickers is found now and then, and interpolation makes a long track of it: so a frame in
 * which nothing was found counts against a track. And a swimmer that crosses the edge of the field is short because the
 * field is small: false tracks are hardly ever found there.
 *
 * @param minimumLength frames a track must span, interpolated ones included, at least 1
 * @param minimumLengthAtEdge the same for a track that begins or ends at the edge of the field
 * @param minimumScore least mean score of the track's frames, in [0, 1], a frame without a detection counting as 0; scores
 *     of other detectors ({@link Level#UNSPECIFIED}) are no probabilities and are not asked
 */
public record TrackFilter(int minimumLength, int minimumLengthAtEdge, double minimumScore) {
    /** What the models' calibrated scores are asked for: chosen on simulated films of their own. */
    private static final double SCORE = 0.3;

    public TrackFilter {
        requireLength("track length", minimumLength);
        requireLength("track length at the edge", minimumLengthAtEdge);
        if (!(minimumScore >= 0 && minimumScore <= 1)) {
            throw new IllegalArgumentException("The minimum track score must lie in 0 to 1, not " + minimumScore);
        }
    }

    /** The paper's filter: length alone, anywhere. */
    public static TrackFilter ofLength(int frames) {
        return new TrackFilter(frames, frames, 0);
    }

    /** Ours: half the length is enough at the edge, and the score is asked too. */
    public static TrackFilter ofSwimmers(int frames) {
        return new TrackFilter(frames, (frames + 1) / 2, SCORE);
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
        int length = last.frame() - first.frame() + 1;
        boolean cut = field != null && (field.isAtEdge(first.box()) || field.isAtEdge(last.box()));
        return length >= (cut ? Math.min(minimumLengthAtEdge, minimumLength) : minimumLength) && isSure(points, length);
    }

    private boolean isSure(List<TrackPoint> points, int length) {
        double sum = 0;
        for (TrackPoint point : points) {
            if (point.detection() != null) {
                if (point.detection().level() == Level.UNSPECIFIED) {
                    return true;
                }
                sum += point.detection().score();
            }
        }
        return sum >= minimumScore * length;
    }

    private static void requireLength(String name, int frames) {
        if (frames < 1) {
            throw new IllegalArgumentException("The minimum %s must be at least 1, not %d".formatted(name, frames));
        }
    }
}
