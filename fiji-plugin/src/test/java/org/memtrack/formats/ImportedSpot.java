// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.util.OptionalDouble;
import org.memtrack.detection.Level;

/**
 * A point of a track as it stands in a file.
 *
 * @param id number in the file
 * @param frame from 0
 * @param x centre, in pixels
 * @param y centre, in pixels
 * @param width of the box, pixels; empty when the file has no size
 * @param height of the box, pixels; empty when the file has no size
 * @param score empty when the file has none
 * @param level {@code UNSPECIFIED} when the file has none
 * @param interpolated whether the file says that no detection stands behind it
 * @param contrast empty when the file has none
 * @param positionError pixels; empty when the file has none
 * @param driftX how far the scene stands right of its place in frame 0, pixels; empty when the file does not say
 * @param driftY how far the scene stands below its place in frame 0, likewise
 */
record ImportedSpot(
        int id,
        int frame,
        double x,
        double y,
        OptionalDouble width,
        OptionalDouble height,
        OptionalDouble score,
        Level level,
        boolean interpolated,
        OptionalDouble contrast,
        OptionalDouble positionError,
        OptionalDouble driftX,
        OptionalDouble driftY) {}
