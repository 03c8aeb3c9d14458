// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import ij.ImagePlus;
import ij.gui.Roi;
import java.awt.Point;
import java.util.BitSet;
import java.util.Locale;
import java.util.Optional;
import org.memtrack.detection.DetectorException;

/** The region the user has selected in an image. */
public final class Regions {
    private Regions() {}

    /**
     * The selection of an image as a mask; empty when nothing is selected.
     *
     * @throws DetectorException when the selection has no area or lies outside the image
     */
    public static Optional<RegionMask> of(ImagePlus image) {
        Roi roi = image.getRoi();
        if (roi == null) {
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
}
