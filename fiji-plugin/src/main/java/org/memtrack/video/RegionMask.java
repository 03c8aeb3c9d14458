// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import java.util.BitSet;

/**
 * A region the user drew, as a mask over the frame.
 *
 * @param width columns, in pixels
 * @param height rows, in pixels
 * @param inside bit {@code y * width + x} is set when pixel (x, y) is inside
 */
public record RegionMask(int width, int height, BitSet inside) {
    public RegionMask {
        inside = (BitSet) inside.clone();
        if (width < 1 || height < 1 || inside.length() > width * height) {
            throw new IllegalArgumentException(
                    "A mask of %d bits over a frame of %d x %d pixels".formatted(inside.length(), width, height));
        }
        if (inside.isEmpty()) {
            throw new IllegalArgumentException("The region holds no pixel");
        }
    }
}
