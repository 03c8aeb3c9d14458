// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import ij.IJ;
import ij.ImageStack;
import ij.VirtualStack;
import ij.io.Opener;
import ij.plugin.FileInfoVirtualStack;
import ij.process.ImageProcessor;
import java.io.File;
import java.util.Optional;

/** Tells the frames of a virtual stack that ImageJ could not read: it gives a picture in their place. */
final class UnreadFile {
    /** What the pixels around ImageJ's note "File not found" are, whatever the type of the samples. */
    private static final float WHITE = 255;

    private UnreadFile() {}

    /** The file that a frame should have been read from; empty when it was, or when the stack is of another kind. */
    static Optional<File> of(ImageStack stack, int slice, ImageProcessor frame) {
        // Not its subclasses, in which these methods may mean other things.
        if (stack.getClass() == VirtualStack.class) {
            VirtualStack folder = (VirtualStack) stack;
            String name = folder.getFileName(folder.translate(slice));
            boolean unread =
                    folder.getDirectory() != null && frame.getf(0) == WHITE && !isPicture(folder.getDirectory(), name);
            return unread ? Optional.of(new File(folder.getDirectory(), name)) : Optional.empty();
        }
        if (stack instanceof FileInfoVirtualStack tiff && tiff.getFileName(slice) != null) {
            return Optional.of(new File(tiff.getDirectory(), tiff.getFileName(slice)))
                    .filter(file -> !file.canRead());
        }
        return Optional.empty();
    }

    /** Opens it a second time, as only that tells a white corner of a frame from ImageJ's note. */
    private static boolean isPicture(String folder, String name) {
        Opener opener = new Opener();
        opener.setSilentMode(true);
        IJ.redirectErrorMessages(true);
        try {
            return opener.openTempImage(folder, name) != null;
        } finally {
            IJ.redirectErrorMessages(false);
        }
    }
}
