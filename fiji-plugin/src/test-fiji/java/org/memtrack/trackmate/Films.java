// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import ij.IJ;
import ij.ImagePlus;
import ij.ImageStack;
import ij.process.FloatProcessor;

/** Films to track in. */
final class Films {
    static final double PIXEL_SIZE = 0.25;
    static final double INTERVAL = 0.5;

    private Films() {}

    /**
     * Two bright discs moving right on a dark ground, 2 px a frame, in rows 20 and 60; the first one is missing in frames
     * 8, 9 and 10.
     */
    static ImagePlus twoSwimmers(int frames) {
        ImageStack stack = new ImageStack(100, 80);
        for (int frame = 0; frame < frames; frame++) {
            FloatProcessor pixels = new FloatProcessor(100, 80);
            if (frame < 8 || frame > 10) {
                draw(pixels, 12 + 2 * frame, 20);
            }
            draw(pixels, 20 + 2 * frame, 60);
            stack.addSlice(pixels.convertToByteProcessor(false));
        }
        ImagePlus film = new ImagePlus("two swimmers", stack);
        film.setDimensions(1, 1, frames);
        film.setOpenAsHyperStack(true);
        film.getCalibration().pixelWidth = PIXEL_SIZE;
        film.getCalibration().pixelHeight = PIXEL_SIZE;
        film.getCalibration().setUnit("micron");
        film.getCalibration().frameInterval = INTERVAL;
        film.getCalibration().setTimeUnit("sec");
        return film;
    }

    private static void draw(FloatProcessor pixels, double x, double y) {
        for (int row = 0; row < pixels.getHeight(); row++) {
            for (int column = 0; column < pixels.getWidth(); column++) {
                double distance2 = (column - x) * (column - x) + (row - y) * (row - y);
                pixels.setf(column, row, pixels.getf(column, row) + (float) (200 * Math.exp(-distance2 / 8)));
            }
        }
    }

    /** A film of TrackMate's own, 50 frames of 128 x 128 pixels. */
    static ImagePlus fakeTracks() {
        ImagePlus film = IJ.openImage(
                org.memtrack.testing.ExaminationData.path("trackmate_files", "FakeTracks.tif").toString());
        if (film.getNFrames() == 1) {
            film.setDimensions(1, 1, film.getStackSize());
        }
        return film;
    }
}
