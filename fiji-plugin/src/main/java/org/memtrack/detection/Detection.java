// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.detection;

/**
 * What a detector found at one place of one frame.
 *
 * @param box where, in pixels of the film as the user sees it
 * @param score how sure the detector is, in [0, 1]; other detectors' qualities may exceed 1
 * @param level which level's detector found it
 */
public record Detection(Box box, double score, Level level) {
    public Detection {
        if (!Double.isFinite(score)) {
            throw new IllegalArgumentException("The score of a detection must be a finite number, not " + score);
        }
    }
}
