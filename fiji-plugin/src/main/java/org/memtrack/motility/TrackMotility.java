// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

import java.util.Optional;
import java.util.OptionalDouble;

/**
 * How one track moves, freed of the drift of the scene.
 *
 * @param trackId number of the track
 * @param meanSpeedPixelsPerFrame mean speed from frame to frame; 0 for a track of one frame
 * @param meanSpeed the same in um/s; empty without pixel size and frame interval
 * @param meanLagSpeed mean speed over the lag of {@link MotilityAnalysis}, um/s; empty without calibration or when the
 *     track is shorter than the lag
 * @param peakDiffusivity greatest MSD(lag) / (4 lag) over the lags, um^2/s; empty without calibration or for one frame
 * @param motilityClass class by the peak diffusivity; empty where that is
 */
public record TrackMotility(
        int trackId,
        double meanSpeedPixelsPerFrame,
        OptionalDouble meanSpeed,
        OptionalDouble meanLagSpeed,
        OptionalDouble peakDiffusivity,
        Optional<MotilityClass> motilityClass) {}
