// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

/**
 * How detections are joined into tracks.
 *
 * @param association how it is decided which detection continues which track; the paper has {@code OVERLAP}, the
 *     default is {@code MOTION}, which switches between swimmers less often
 * @param iouGate least intersection over union of a detection with the predicted box, in [0, 1); used by
 *     {@code OVERLAP} (authors' code; the paper gives none)
 * @param maximumAge frames a track may go on without a detection, at least 0 (paper section "Interpolated Tracker")
 * @param minimumHits detections a track needs, at least 0 (paper section "Interpolated Tracker"). {@code AUTHORS}: points
 *     are reported only after that many consecutive ones, as in SORT; {@code FILL_GAPS}: a track with fewer is dropped
 * @param interpolation what stands in a track where no detection was found
 * @param smooth whether detections are brought to where their swimmer most likely was, as far as their place is unsure; used
 *     by {@code FILL_GAPS}, and not a part of the paper
 * @param filter which tracks are kept (paper section "Track Length Filter": at least 60 frames in collagen, 30 in water)
 */
public record SortSettings(
        Association association,
        double iouGate,
        int maximumAge,
        int minimumHits,
        Interpolation interpolation,
        boolean smooth,
        TrackFilter filter) {

    /** Films in collagen and other dense media, where swimmers are slow: tracks of 60 frames. */
    public static final SortSettings COLLAGEN = new SortSettings(
            Association.MOTION, 0.05, 25, 0, Interpolation.FILL_GAPS, true, TrackFilter.ofSwimmers(60));

    /** Films in water, where swimmers soon leave the focal plane: tracks of 30 frames. */
    public static final SortSettings WATER = COLLAGEN.with(TrackFilter.ofSwimmers(30));

    public static final SortSettings DEFAULTS = COLLAGEN;

    public SortSettings {
        if (!(iouGate >= 0 && iouGate < 1)) {
            throw new IllegalArgumentException("The IoU gate must lie in [0, 1), not " + iouGate);
        }
        requireAtLeast("maximum age", 0, maximumAge);
        requireAtLeast("minimum hits", 0, minimumHits);
    }

    /** The same settings with another filter. */
    public SortSettings with(TrackFilter newFilter) {
        return new SortSettings(association, iouGate, maximumAge, minimumHits, interpolation, smooth, newFilter);
    }

    private static void requireAtLeast(String name, int least, int value) {
        if (value < least) {
            throw new IllegalArgumentException("The %s must be at least %d, not %d".formatted(name, least, value));
        }
    }
}
