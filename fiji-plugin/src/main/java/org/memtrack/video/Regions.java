// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import ij.ImagePlus;
import ij.gui.Line;
import ij.gui.Roi;
import ij.io.RoiEncoder;
import java.awt.Point;
import java.awt.Rectangle;
import java.util.Base64;
import java.util.BitSet;
import java.util.LinkedHashMap;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import org.memtrack.detection.DetectorException;

/** What the user has selected in an image: a region to look in, or a line along a cell, which tells its length. */
public final class Regions {
    /** Bytes of a selection that are noted; one that was made from a mask may have far more. */
    private static final int MOST_BYTES = 1 << 16;

    private Regions() {}

    /**
     * The selection of an image as a mask; empty when nothing is selected, or a straight line.
     *
     * @throws DetectorException when the selection has no area or lies outside the image
     */
    public static Optional<RegionMask> of(ImagePlus image) {
        Roi roi = image.getRoi();
        if (roi == null || roi instanceof Line) {
            return Optional.empty();
        }
        if (!roi.isArea()) {
            throw new DetectorException(
                    "The selection in \"%s\" is a %s and has no area: remove it with Edit > Selection"
                                    .formatted(
                                            image.getTitle(),
                                            roi.getTypeAsString().toLowerCase(Locale.ROOT))
                            + " > Select None, or draw a region.");
        }
        int width = image.getWidth();
        int height = image.getHeight();
        BitSet inside = new BitSet(width * height);
        for (Point point : roi) {
            if (point.x >= 0 && point.x < width && point.y >= 0 && point.y < height) {
                inside.set(point.y * width + point.x);
            }
        }
        if (inside.isEmpty()) {
            throw new DetectorException(
                    "The selection in \"%s\" lies outside the image: remove it with Edit > Selection >"
                                    .formatted(image.getTitle())
                            + " Select None, or draw a region.");
        }
        return Optional.of(new RegionMask(width, height, inside));
    }

    /** Length in pixels of the straight line that is selected in an image; empty where none is. */
    public static OptionalDouble lineLength(ImagePlus image) {
        return image.getRoi() instanceof Line line ? OptionalDouble.of(line.getRawLength()) : OptionalDouble.empty();
    }

    /**
     * The region of an image as ImageJ can rebuild it; empty when none is selected.
     *
     * @return kind, x, y, width and height of the bounds in pixels, and roi: ImageJ's .roi file in Base64, left out where it
     *     is large
     */
    public static Map<String, Object> describe(ImagePlus image) {
        Map<String, Object> values = new LinkedHashMap<>();
        Roi roi = image.getRoi();
        if (roi != null && roi.isArea()) {
            Rectangle bounds = roi.getBounds();
            values.put("kind", roi.getTypeAsString());
            values.put("x", bounds.x);
            values.put("y", bounds.y);
            values.put("width", bounds.width);
            values.put("height", bounds.height);
            byte[] file = RoiEncoder.saveAsByteArray(roi);
            if (file.length <= MOST_BYTES) {
                values.put("roi", Base64.getEncoder().encodeToString(file));
            }
        }
        return values;
    }
}
