// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import ij.measure.Calibration;
import java.util.BitSet;
import java.util.Optional;
import net.imagej.ImgPlus;
import net.imagej.axis.Axes;
import net.imagej.axis.CalibratedAxis;
import net.imglib2.Interval;
import net.imglib2.RandomAccessibleInterval;
import net.imglib2.type.numeric.RealType;
import net.imglib2.view.Views;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.RegionMask;
import org.memtrack.video.Units;

/**
 * What TrackMate asks a global detector to look at.
 *
 * @param film the frames asked for, whole: the detector needs the surroundings, too
 * @param region the part of each frame asked for; null for all of it
 * @param pixelWidth edge of a pixel in the unit of length that spots are to have
 * @param pixelHeight likewise
 */
record FilmOfImg(ImgFilm film, @Nullable RegionMask region, double pixelWidth, double pixelHeight) {

    /**
     * Takes a channel and an interval out of an image.
     *
     * @param channel from 0
     * @param interval x, y and, when the image has them, z and time, without channel: so TrackMate hands it over
     * @throws DetectorException when there is no such channel, or the image is no film of one plane
     */
    static <T extends RealType<T>> FilmOfImg of(ImgPlus<T> image, int channel, Interval interval) {
        // TrackMate claims that every image is of real numbers, but wraps colour images as well.
        Object sample = image.randomAccess().get();
        if (!(sample instanceof RealType)) {
            throw new DetectorException(
                    "\"%s\" is a colour image: make it grey with Image > Type > 8-bit.".formatted(image.getName()));
        }
        int z = image.dimensionIndex(Axes.Z);
        if (z >= 0 && image.dimension(z) > 1) {
            throw new DetectorException(("\"%s\" has %d slices in Z: if they are its frames, swap Z and T in Image >"
                            + " Properties, else project them with Image > Stacks > Z Project.")
                    .formatted(image.getName(), image.dimension(z)));
        }
        int c = image.dimensionIndex(Axes.CHANNEL);
        long channels = c < 0 ? 1 : image.dimension(c);
        if (channel >= channels) {
            throw new DetectorException("\"%s\" has %d channels: choose one of them instead of channel %d."
                    .formatted(image.getName(), channels, channel + 1));
        }
        int time = image.dimensionIndex(Axes.TIME);
        RandomAccessibleInterval<T> frames = image;
        if (c >= 0) {
            frames = Views.hyperSlice(frames, c, channel);
        }
        if (time < 0) {
            frames = Views.addDimension(frames, 0, 0);
        }
        int last = interval.numDimensions() - 1;
        int firstFrame = time < 0 ? 0 : (int) interval.min(last);
        int frameCount = time < 0 ? 1 : (int) interval.dimension(last);
        Calibration calibration = calibration(image, time);
        FilmInfo info = new FilmInfo(
                image.getName(),
                Optional.empty(),
                (int) image.dimension(0),
                (int) image.dimension(1),
                frameCount,
                Units.pixelSizeMicrometres(calibration),
                Units.frameIntervalSeconds(calibration));
        return new FilmOfImg(
                new ImgFilm(frames, info, firstFrame),
                region(info, interval),
                calibration.pixelWidth,
                calibration.pixelHeight);
    }

    private static Calibration calibration(ImgPlus<?> image, int time) {
        Calibration calibration = new Calibration();
        CalibratedAxis x = (CalibratedAxis) image.axis(0);
        calibration.pixelWidth = x.averageScale(0, 1);
        calibration.pixelHeight = ((CalibratedAxis) image.axis(1)).averageScale(0, 1);
        calibration.setUnit(x.unit());
        if (time >= 0) {
            CalibratedAxis t = (CalibratedAxis) image.axis(time);
            calibration.frameInterval = t.averageScale(0, 1);
            if (t.unit() != null) {
                calibration.setTimeUnit(t.unit());
            }
        }
        return calibration;
    }

    private static @Nullable RegionMask region(FilmInfo info, Interval interval) {
        if (interval.dimension(0) >= info.width() && interval.dimension(1) >= info.height()) {
            return null;
        }
        BitSet inside = new BitSet(info.width() * info.height());
        for (long y = Math.max(0, interval.min(1)); y <= Math.min(info.height() - 1, interval.max(1)); y++) {
            int row = (int) y * info.width();
            inside.set(
                    row + (int) Math.max(0, interval.min(0)),
                    row + (int) Math.min(info.width() - 1, interval.max(0)) + 1);
        }
        return new RegionMask(info.width(), info.height(), inside);
    }
}
