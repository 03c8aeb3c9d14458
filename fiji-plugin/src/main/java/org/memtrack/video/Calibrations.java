// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import ij.ImagePlus;
import ij.io.FileInfo;
import ij.measure.Calibration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.OptionalDouble;

/**
 * Pixel size and frame interval of a film, with what the user should know about them.
 *
 * @param pixelSizeMicrometres empty when nobody says
 * @param frameIntervalSeconds empty when nobody says
 * @param warnings one sentence each
 */
record Calibrations(OptionalDouble pixelSizeMicrometres, OptionalDouble frameIntervalSeconds, List<String> warnings) {

    private static final String PIXEL_SIZE = "Pixel size (pixel_size)";
    private static final String FRAME_INTERVAL = "Frame interval (frame_interval)";

    /** What the user said, and where they said nothing, what the image says. */
    static Calibrations of(ImagePlus image, FilmOptions options) {
        Calibration calibration = image.getCalibration();
        List<String> warnings = new ArrayList<>();
        OptionalDouble pixelSize = options.pixelSizeMicrometres();
        if (pixelSize.isEmpty()) {
            pixelSize = Units.pixelSizeMicrometres(calibration);
            if (pixelSize.isPresent() && Math.abs(calibration.pixelHeight / calibration.pixelWidth - 1) > 0.01) {
                warnings.add(String.format(
                        Locale.ROOT,
                        "The pixels are not square (%s x %s %s); their width is used in both directions.",
                        calibration.pixelWidth,
                        calibration.pixelHeight,
                        calibration.getUnit()));
            }
        }
        OptionalDouble interval = options.frameIntervalSeconds();
        if (interval.isEmpty()) {
            interval = Units.frameIntervalSeconds(calibration);
            // The AVI reader gives the frame rate only; of other films it is that of ImageJ's animation.
            if (interval.isEmpty() && calibration.fps > 0 && isAvi(image)) {
                interval = OptionalDouble.of(1 / calibration.fps);
                warnings.add(String.format(
                        Locale.ROOT,
                        "The frame interval, %.4g s, is taken from the film's playback rate; if it was recorded at"
                                + " another rate, give %s.",
                        interval.getAsDouble(),
                        FRAME_INTERVAL));
            }
        }
        if (pixelSize.isEmpty() || interval.isEmpty()) {
            warnings.add(
                    "The film has no %s: speeds are reported in pixels per frame; to have them in um/s, set what is missing in Image > Properties or give %s."
                            .formatted(
                                    String.join(
                                            " and no ",
                                            Units.untold(pixelSize, "pixel size", interval, "frame interval")),
                                    String.join(
                                            " and ", Units.untold(pixelSize, PIXEL_SIZE, interval, FRAME_INTERVAL))));
        }
        return new Calibrations(pixelSize, interval, warnings);
    }

    private static boolean isAvi(ImagePlus image) {
        FileInfo source = image.getOriginalFileInfo();
        return source != null
                && source.fileName != null
                && source.fileName.toLowerCase(Locale.ROOT).endsWith(".avi");
    }
}
