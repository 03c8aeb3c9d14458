// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

import java.util.Optional;
import java.util.OptionalDouble;

/**
 * How one track moves, freed of the drift of the scene.
 *
 * @param trackId number of the track
 * @param meanSpeedPixelsPerFrame length of the path from detection to detection over its time; empty for one detection.
 *     Errors of position make it too great where bacteria move less than a pixel a frame
 * @param lagFrames lag of the lag speed: {@link MotilityAnalysis#SPEED_LAG_SECONDS} in frames
 * @param lagSpeedPixelsPerFrame mean distance over the lag, divided by it; empty when no two detections lie that far apart
 * @param meanSpeed as {@code meanSpeedPixelsPerFrame}, um/s; empty without pixel size and frame interval, too
 * @param lagSpeed as {@code lagSpeedPixelsPerFrame}, um/s; empty without pixel size and frame interval, too
 * @param peakDiffusivity greatest diffusivity over the lags, um^2/s (see {@link MotilityAnalysis}); empty
 *     without pixel size and frame interval, or when the track is too short
 * @param motilityClass class by the peak diffusivity; empty where that is
 */
public record TrackMotility(
        int trackId,
        OptionalDouble meanSpeedPixelsPerFrame,
        int lagFrames,
        OptionalDouble lagSpeedPixelsPerFrame,
        OptionalDouble meanSpeed,
        OptionalDouble lagSpeed,
        OptionalDouble peakDiffusivity,
        Optional<MotilityClass> motilityClass) {}
