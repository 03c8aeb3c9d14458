// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import ij.measure.Calibration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.OptionalDouble;

/** Reads micrometres and seconds out of ImageJ's calibration, whose units are free text. */
public final class Units {
    /** Pixels on a screen or in print are larger as a rule, 300 an inch being 85 um; those of a microscope are smaller. */
    private static final double LARGEST_PIXEL_MICROMETRES = 50;

    private Units() {}

    /** The names of what a film does not tell, of these two; speeds in um/s want both. */
    public static List<String> untold(
            OptionalDouble pixelSize,
            String nameOfPixelSize,
            OptionalDouble frameInterval,
            String nameOfFrameInterval) {
        List<String> names = new ArrayList<>();
        if (pixelSize.isEmpty()) {
            names.add(nameOfPixelSize);
        }
        if (frameInterval.isEmpty()) {
            names.add(nameOfFrameInterval);
        }
        return names;
    }

    /**
     * Edge of a pixel in micrometres; empty when the image is in pixels, in an unknown unit, or as large as in print: in inches
     * or centimetres, with pixels of more than 50 um.
     */
    public static OptionalDouble pixelSizeMicrometres(Calibration calibration) {
        double micrometres = switch (calibration.getUnit().trim().toLowerCase(Locale.ROOT)) {
            case "nm", "nanometer", "nanometre", "nanometers", "nanometres" -> 1e-3;
            // Both micro signs: Latin-1 and Greek.
            case "\u00b5m",
                    "\u03bcm",
                    "um",
                    "micron",
                    "microns",
                    "micrometer",
                    "micrometre",
                    "micrometers",
                    "micrometres" -> 1;
            case "mm", "millimeter", "millimetre", "millimeters", "millimetres" -> 1e3;
            case "cm", "centimeter", "centimetre" -> 1e4;
            case "in", "inch", "inches" -> 2.54e4;
            case "m", "meter", "metre" -> 1e6;
            default -> 0;
        };
        OptionalDouble size = scaled(calibration.pixelWidth, micrometres);
        // A TIFF tells in these units how large it is in print, unless a microscope's software puts the true size
        // there.
        boolean mayBeOfPrint = micrometres == 1e4 || micrometres == 2.54e4;
        return mayBeOfPrint && size.orElse(0) > LARGEST_PIXEL_MICROMETRES ? OptionalDouble.empty() : size;
    }

    /** Time between two frames in seconds; empty when the image does not say or names an unknown unit. */
    public static OptionalDouble frameIntervalSeconds(Calibration calibration) {
        String unit = calibration.getTimeUnit();
        return scaled(
                calibration.frameInterval,
                switch (unit == null ? "s" : unit.trim().toLowerCase(Locale.ROOT)) {
                    case "\u00b5s", "\u03bcs", "us", "usec" -> 1e-6;
                    case "ms", "msec", "millisecond", "milliseconds" -> 1e-3;
                    case "s", "sec", "second", "seconds" -> 1;
                    case "min", "minute", "minutes" -> 60;
                    case "h", "hr", "hour", "hours" -> 3600;
                    default -> 0;
                });
    }

    private static OptionalDouble scaled(double value, double factor) {
        double product = value * factor;
        return product > 0 && Double.isFinite(product) ? OptionalDouble.of(product) : OptionalDouble.empty();
    }
}
