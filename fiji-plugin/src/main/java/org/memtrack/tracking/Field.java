// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import org.memtrack.detection.Box;

/**
 * What the film shows.
 *
 * @param width in pixels
 * @param height in pixels
 */
public record Field(int width, int height) {
    /** Whether a box reaches the edge of the field. */
    boolean isAtEdge(Box box) {
        return box.xMin() <= 0 || box.yMin() <= 0 || box.xMax() >= width - 1 || box.yMax() >= height - 1;
    }
}
