// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import ij.ImagePlus;
import ij.ImageStack;
import ij.process.ImageProcessor;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.stream.Stream;
import org.memtrack.detection.DetectorException;

/** A film that ImageJ has open, in memory or as a virtual stack. */
public class ImageFilm implements Film {
    private final ImagePlus image;
    private final ImageStack stack;
    private final FilmOptions options;
    private final FilmInfo info;
    private final Optional<Path> openedFrom;
    private final SampleType sampleType;
    private final List<String> warnings;

    /**
     * The film that the options pick out of an image.
     *
     * @throws DetectorException when the image is not grey, its frames lie on another axis, or it has no such channel
     *     or frames
     */
    public ImageFilm(ImagePlus image, FilmOptions options) {
        this.image = image;
        this.stack = image.getStack();
        this.options = options;
        this.sampleType = sampleType(image);
        checkAxes(image, options.frameAxis());
        if (options.channel() > image.getNChannels()) {
            throw new DetectorException("\"%s\" has %d channels: choose one of them instead of channel %d."
                    .formatted(image.getTitle(), image.getNChannels(), options.channel()));
        }
        int all = options.frameAxis() == FrameAxis.T ? image.getNFrames() : image.getNSlices();
        int last = options.lastFrame() == 0 ? all : options.lastFrame();
        if (last > all || options.firstFrame() > last) {
            throw new DetectorException("\"%s\" has %d frames: choose a range within 1 to %d instead of %d to %d."
                    .formatted(image.getTitle(), all, all, options.firstFrame(), last));
        }
        Calibrations calibrations = Calibrations.of(image, options);
        FilmFile file = FilmFile.of(image);
        this.openedFrom = file.openedFrom();
        this.warnings = Stream.of(file.warnings(), calibrations.warnings())
                .flatMap(List::stream)
                .toList();
        this.info = new FilmInfo(
                image.getTitle(),
                file.path(),
                image.getWidth(),
                image.getHeight(),
                last - options.firstFrame() + 1,
                calibrations.pixelSizeMicrometres(),
                calibrations.frameIntervalSeconds());
    }

    /** Whether an image that has frames has them on Z, as ImageJ opens AVI files and folders of pictures. */
    public static boolean framesLieOnZ(ImagePlus image) {
        return image.getNFrames() == 1 && image.getNSlices() > 1;
    }

    /** Edge of a pixel as the image says, micrometres; empty when it is not calibrated. */
    public static OptionalDouble pixelSizeMicrometres(ImagePlus image) {
        return Units.pixelSizeMicrometres(image.getCalibration());
    }

    /** Time between two frames as the image says, seconds; empty when it does not. */
    public static OptionalDouble frameIntervalSeconds(ImagePlus image) {
        return Units.frameIntervalSeconds(image.getCalibration());
    }

    /** What the user should know about this film, one sentence each. */
    public List<String> warnings() {
        return warnings;
    }

    @Override
    public FilmInfo info() {
        return info;
    }

    @Override
    public Optional<Path> openedFrom() {
        return openedFrom;
    }

    @Override
    public SampleType sampleType() {
        return sampleType;
    }

    @Override
    public int firstFrame() {
        return options.firstFrame() - 1;
    }

    /** The image the film is taken from. */
    public ImagePlus image() {
        return image;
    }

    /** Slice of the image's stack, from 1, that holds a frame, from 0. */
    public int sliceOf(int frame) {
        int counted = options.firstFrame() + frame;
        return options.frameAxis() == FrameAxis.T
                ? image.getStackIndex(options.channel(), 1, counted)
                : image.getStackIndex(options.channel(), counted, 1);
    }

    /**
     * A frame, from 0, as ImageJ holds it; not to be changed.
     *
     * @throws DetectorException when it cannot be read, as a file of the film is gone or damaged
     */
    public ImageProcessor processor(int frame) {
        int slice = sliceOf(frame);
        ImageProcessor processor = stack.getProcessor(slice);
        if (processor == null || processor.getWidth() != info.width() || processor.getHeight() != info.height()) {
            throw new DetectorException(
                    "Slice %d of \"%s\" cannot be read: open the film again and check that its files are"
                                    .formatted(slice, info.title())
                            + " still there.");
        }
        UnreadFile.of(stack, slice, processor).ifPresent(file -> {
            throw new DetectorException(
                    "Slice %d of \"%s\" cannot be read from %s: check that the file is there and not damaged, and open the film again."
                            .formatted(slice, info.title(), file));
        });
        return processor;
    }

    @Override
    public byte[] frame(int frame) {
        Object pixels = processor(frame).getPixels();
        if (pixels instanceof byte[] samples) {
            return samples.clone();
        }
        ByteBuffer bytes = ByteBuffer.allocate(info.width() * info.height() * sampleType.bytes())
                .order(ByteOrder.LITTLE_ENDIAN);
        if (pixels instanceof short[] samples) {
            bytes.asShortBuffer().put(samples);
        } else {
            bytes.asFloatBuffer().put((float[]) pixels);
        }
        return bytes.array();
    }

    private static SampleType sampleType(ImagePlus image) {
        return switch (image.getType()) {
            case ImagePlus.GRAY8 -> SampleType.UINT8;
            case ImagePlus.GRAY16 -> SampleType.UINT16;
            case ImagePlus.GRAY32 -> SampleType.FLOAT32;
            default ->
                throw new DetectorException("\"%s\" is a colour image: make it grey with Image > Type > 8-bit."
                        .formatted(image.getTitle()));
        };
    }

    private static void checkAxes(ImagePlus image, FrameAxis axis) {
        if (axis == FrameAxis.T && framesLieOnZ(image)) {
            throw new DetectorException(
                    ("\"%s\" has %d slices in Z and a single frame: if the slices are its frames, choose z"
                                    + " for Frames lie on (in a macro: frames=z), or swap Z and T in Image > Properties.")
                            .formatted(image.getTitle(), image.getNSlices()));
        }
        if (image.getNSlices() > 1 && image.getNFrames() > 1) {
            throw new DetectorException(("\"%s\" has both %d slices in Z and %d frames: make one plane of each frame"
                            + " first, with Image > Stacks > Z Project.")
                    .formatted(image.getTitle(), image.getNSlices(), image.getNFrames()));
        }
        if (axis == FrameAxis.Z && image.getNFrames() > 1) {
            throw new DetectorException(
                    "\"%s\" has its %d frames on T: choose t for Frames lie on (in a macro: leave frames=z out)."
                            .formatted(image.getTitle(), image.getNFrames()));
        }
    }
}
