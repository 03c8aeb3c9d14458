// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;
import org.memtrack.video.RegionMask;

/**
 * How to detect in a film.
 *
 * @param model name of the model, [a-z0-9_.-]{1,64}; empty for the server's default model
 * @param modelVersion version of the model; empty for its newest
 * @param criterion which of the model's stored thresholds to use
 * @param thresholds thresholds that take the place of the criterion's; null to use the criterion's
 * @param maxSizePx boxes wider or taller than this are dropped, pixels at the model's scale; null for 35, as in the paper
 * @param nmsIou of two boxes whose intersection over union exceeds this, in [0, 1], the weaker is dropped; null for 0.7, as
 *     in the paper
 * @param stabilise whether to measure and undo the drift of the stage before the temporal median
 * @param resting whether to find bacteria that rest all through the film, too: what stays in its place and is as dark or as
 *     bright as those that move, some debris with it
 * @param cellLengthPx length of a cell as it looks in this film, in pixels, from {@value #LEAST_CELL_LENGTH_PX} to
 *     {@value #GREATEST_CELL_LENGTH_PX}; the film is scaled by it, whatever its pixel size; null to go by the pixel size, at
 *     which cells are taken to be 2 um long, or without one not to scale
 * @param region where to report detections; null for everywhere
 */
public record DetectionSettings(
        String model,
        String modelVersion,
        Criterion criterion,
        @Nullable Thresholds thresholds,
        @Nullable Double maxSizePx,
        @Nullable Double nmsIou,
        boolean stabilise,
        boolean resting,
        @Nullable Double cellLengthPx,
        @Nullable RegionMask region) {

    /** What the server takes for the length of a cell, at least. */
    public static final int LEAST_CELL_LENGTH_PX = 1;

    /** What the server takes for the length of a cell, at most. */
    public static final int GREATEST_CELL_LENGTH_PX = 200;

    private static final Pattern NAME = Pattern.compile("[a-z0-9_.-]{0,64}");

    /** The default model over the whole film, at maximum F1: false positives are dropped with their tracks. */
    public static final DetectionSettings DEFAULTS =
            new DetectionSettings("", "", Criterion.MAXIMUM_F1, null, null, null, true, false, null, null);

    public DetectionSettings {
        if (!NAME.matcher(model).matches()) {
            throw new IllegalArgumentException(
                    "A model's name has 1 to 64 of a-z, 0-9, '_', '.' and '-', not \"%s\"".formatted(model));
        }
        if (maxSizePx != null && !(maxSizePx > 0 && Double.isFinite(maxSizePx))) {
            throw new IllegalArgumentException("The greatest size must be a positive number, not " + maxSizePx);
        }
        if (cellLengthPx != null
                && !(cellLengthPx >= LEAST_CELL_LENGTH_PX && cellLengthPx <= GREATEST_CELL_LENGTH_PX)) {
            throw new IllegalArgumentException("The cell length must lie in %d to %d pixels, not %s"
                    .formatted(LEAST_CELL_LENGTH_PX, GREATEST_CELL_LENGTH_PX, cellLengthPx));
        }
        if (nmsIou != null && !(nmsIou >= 0 && nmsIou <= 1)) {
            throw new IllegalArgumentException("The overlap must lie in 0 to 1, not " + nmsIou);
        }
    }

    /** The same settings, reporting only inside a region. */
    public DetectionSettings withRegion(@Nullable RegionMask newRegion) {
        return new DetectionSettings(
                model,
                modelVersion,
                criterion,
                thresholds,
                maxSizePx,
                nmsIou,
                stabilise,
                resting,
                cellLengthPx,
                newRegion);
    }
}
