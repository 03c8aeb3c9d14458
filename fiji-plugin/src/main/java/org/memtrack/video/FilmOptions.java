// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import java.util.OptionalDouble;

/**
 * What of an image is the film, and what the user knows better than the image.
 *
 * @param frameAxis dimension that holds the frames
 * @param channel from 1, as ImageJ counts
 * @param firstFrame from 1, as ImageJ counts
 * @param lastFrame from 1, as ImageJ counts; 0 for the last one
 * @param pixelSizeMicrometres takes the place of the image's own; empty to use the image's
 * @param frameIntervalSeconds takes the place of the image's own; empty to use the image's
 */
public record FilmOptions(
        FrameAxis frameAxis,
        int channel,
        int firstFrame,
        int lastFrame,
        OptionalDouble pixelSizeMicrometres,
        OptionalDouble frameIntervalSeconds) {
    /** Channel 1, every frame along T, calibrated as the image is. */
    public static final FilmOptions DEFAULTS =
            new FilmOptions(FrameAxis.T, 1, 1, 0, OptionalDouble.empty(), OptionalDouble.empty());

    public FilmOptions {
        if (channel < 1) {
            throw new IllegalArgumentException("Channels are counted from 1, not " + channel);
        }
        if (firstFrame < 1 || lastFrame < 0 || lastFrame > 0 && lastFrame < firstFrame) {
            throw new IllegalArgumentException(
                    "Frames %d to %d are no range; frames are counted from 1".formatted(firstFrame, lastFrame));
        }
        FilmInfo.requirePositive("pixel size", pixelSizeMicrometres);
        FilmInfo.requirePositive("frame interval", frameIntervalSeconds);
    }
}
