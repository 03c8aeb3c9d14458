// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.detection;

/**
 * What a detector found at one place of one frame.
 *
 * @param box where, in pixels of the film as the user sees it
 * @param score how sure the detector is, in [0, 1]; other detectors' qualities may exceed 1
 * @param level which level's detector found it
 * @param contrast how much brighter (above 0) or darker than the background it is, in [-1, 1]; NaN when not known
 * @param error how far off the centre is to be expected along x or y, root mean square, pixels; NaN when not known
 */
public record Detection(Box box, double score, Level level, double contrast, double error) {
    public Detection {
        if (!Double.isFinite(score)) {
            throw new IllegalArgumentException("The score of a detection must be a finite number, not " + score);
        }
    }

    /** A detection whose contrast and error are not known. */
    public Detection(Box box, double score, Level level) {
        this(box, score, level, Double.NaN, Double.NaN);
    }

    /** The same seen at another place. */
    public Detection at(Box place) {
        return new Detection(place, score, level, contrast, error);
    }
}
