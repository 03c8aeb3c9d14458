// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import ij.ImagePlus;
import ij.ImageStack;
import ij.io.FileSaver;
import ij.process.ByteProcessor;
import java.nio.file.Path;
import java.util.Random;

/**
 * A film that any model must track: dark rods of 7 x 3 pixels swim over a quiet background, each in its own lane. It does not
 * change with the simulator, so that these tests tell of the way through the program and not of the model.
 */
final class SwimmersFilm {
    static final int SWIMMERS = 5;

    private SwimmersFilm() {}

    /** Saves the film as TIFF, its frames on T. */
    static void save(Path file, int frames, int width, int height) {
        Random noise = new Random(1);
        ImageStack stack = new ImageStack(width, height);
        for (int frame = 0; frame < frames; frame++) {
            byte[] pixels = new byte[width * height];
            for (int i = 0; i < pixels.length; i++) {
                double grey = 140 + 3 * noise.nextGaussian();
                for (int swimmer = 0; swimmer < SWIMMERS; swimmer++) {
                    grey -= rod(i % width - x(swimmer, frame, frames, width), i / width - y(swimmer, frame, height));
                }
                pixels[i] = (byte) Math.round(grey);
            }
            stack.addSlice(new ByteProcessor(width, height, pixels));
        }
        ImagePlus image = new ImagePlus(file.getFileName().toString(), stack);
        image.setDimensions(1, 1, frames);
        image.setOpenAsHyperStack(true);
        new FileSaver(image).saveAsTiff(file.toString());
    }

    /** Centre of a swimmer, pixels: right and left by turns, through the middle 70 % of the frame. */
    static double x(int swimmer, int frame, int frames, int width) {
        double share = 0.15 + 0.7 * frame / frames;
        return (swimmer % 2 == 0 ? share : 1 - share) * width;
    }

    /** Centre of a swimmer, pixels. */
    static double y(int swimmer, int frame, int height) {
        return (swimmer + 0.5) / SWIMMERS * height + 6 * Math.sin(frame / 6.0 + swimmer);
    }

    private static double rod(double dx, double dy) {
        return 70 * Math.exp(-dx * dx / (2 * 2.6 * 2.6) - dy * dy / (2 * 1.3 * 1.3));
    }
}
