// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

/** Dimension of an image that holds the frames of a film. */
public enum FrameAxis {
    /** Time, as it should be. */
    T,
    /** Depth, as ImageJ opens AVI files and folders of pictures. */
    Z
}
