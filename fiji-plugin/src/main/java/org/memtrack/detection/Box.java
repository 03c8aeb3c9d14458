// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.detection;

/**
 * An upright box in pixels; the centre of pixel (0, 0) has the coordinates (0, 0).
 *
 * @param xMin left edge
 * @param yMin upper edge
 * @param xMax right edge, not left of {@code xMin}
 * @param yMax lower edge, not above {@code yMin}
 */
public record Box(double xMin, double yMin, double xMax, double yMax) {
    public Box {
        if (!(xMin <= xMax && yMin <= yMax) || !Double.isFinite(xMax - xMin + (yMax - yMin))) {
            throw new IllegalArgumentException(
                    "Not a box: x from %s to %s, y from %s to %s".formatted(xMin, xMax, yMin, yMax));
        }
    }

    /** The box of the given size, in pixels, around a centre. */
    public static Box around(double centreX, double centreY, double width, double height) {
        return new Box(centreX - width / 2, centreY - height / 2, centreX + width / 2, centreY + height / 2);
    }

    public double centreX() {
        return (xMin + xMax) / 2;
    }

    public double centreY() {
        return (yMin + yMax) / 2;
    }

    public double width() {
        return xMax - xMin;
    }

    public double height() {
        return yMax - yMin;
    }

    public double area() {
        return width() * height();
    }

    /** Distance of its centre from another box's, pixels. */
    public double distance(Box other) {
        return Math.hypot(other.centreX() - centreX(), other.centreY() - centreY());
    }

    /** Intersection over union with another box, in [0, 1]; 0 when both are empty. */
    public double iou(Box other) {
        double width = Math.min(xMax, other.xMax) - Math.max(xMin, other.xMin);
        double height = Math.min(yMax, other.yMax) - Math.max(yMin, other.yMin);
        if (width <= 0 || height <= 0) {
            return 0;
        }
        double intersection = width * height;
        return intersection / (area() + other.area() - intersection);
    }
}
