// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.testing;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Map;
import java.util.random.RandomGenerator;
import java.util.random.RandomGeneratorFactory;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;

/**
 * Swimmers that run and tumble, and what a detector with misses and false alarms says of them; the same for the same seed.
 *
 * @param frames what the detector says
 * @param swimmerOf which swimmer stands behind a detection; a false alarm is missing
 * @param truth where swimmer i is in frame f: {@code truth.get(i)[f]} as x, y in pixels
 */
public record RandomWorld(List<FrameDetections> frames, Map<Detection, Integer> swimmerOf, List<double[][]> truth) {

    /**
     * What the world is like.
     *
     * @param width of the field, pixels
     * @param height of the field, pixels
     * @param frames of the film
     * @param swimmers in the field, all the time
     * @param speed mean speed, pixels a frame; one swimmer in five rests
     * @param tumble probability that a swimmer takes a new direction, a frame
     * @param boxSize edge of the boxes, pixels
     * @param jitter standard deviation of a box's centre, pixels
     * @param miss probability that a swimmer in focus is missed, a frame
     * @param leaveFocus probability that a swimmer leaves the focal plane, a frame
     * @param returnToFocus probability that it comes back, a frame
     * @param falseAlarms a frame, on average
     */
    public record Settings(
            int width,
            int height,
            int frames,
            int swimmers,
            double speed,
            double tumble,
            double boxSize,
            double jitter,
            double miss,
            double leaveFocus,
            double returnToFocus,
            double falseAlarms) {}

    private static final class Swimmer {
        double x;
        double y;
        double speed;
        double heading;
        boolean inFocus = true;
    }

    public static RandomWorld of(Settings settings, long seed) {
        RandomGenerator random = RandomGeneratorFactory.of("L64X128MixRandom").create(seed);
        List<Swimmer> swimmers = new ArrayList<>();
        List<double[][]> truth = new ArrayList<>();
        for (int i = 0; i < settings.swimmers; i++) {
            Swimmer swimmer = new Swimmer();
            swimmer.x = random.nextDouble(settings.width);
            swimmer.y = random.nextDouble(settings.height);
            swimmer.heading = random.nextDouble(2 * Math.PI);
            swimmer.speed = random.nextDouble() < 0.2 ? 0 : settings.speed * random.nextDouble(0.5, 1.5);
            swimmers.add(swimmer);
            truth.add(new double[settings.frames][]);
        }
        Map<Detection, Integer> swimmerOf = new IdentityHashMap<>();
        List<FrameDetections> frames = new ArrayList<>();
        for (int frame = 0; frame < settings.frames; frame++) {
            List<Detection> detections = new ArrayList<>();
            for (int i = 0; i < swimmers.size(); i++) {
                Swimmer swimmer = swimmers.get(i);
                move(swimmer, settings, random);
                truth.get(i)[frame] = new double[] {swimmer.x, swimmer.y};
                if (swimmer.inFocus && random.nextDouble() >= settings.miss) {
                    Detection detection = detect(
                            swimmer.x + settings.jitter * random.nextGaussian(),
                            swimmer.y + settings.jitter * random.nextGaussian(),
                            random.nextDouble(0.5, 1),
                            settings,
                            random);
                    detections.add(detection);
                    swimmerOf.put(detection, i);
                }
            }
            for (double left = settings.falseAlarms; random.nextDouble() < left; left--) {
                detections.add(detect(
                        random.nextDouble(settings.width),
                        random.nextDouble(settings.height),
                        random.nextDouble(0.3, 0.8),
                        settings,
                        random));
            }
            frames.add(new FrameDetections(frame, suppressOverlapping(detections)));
        }
        return new RandomWorld(frames, swimmerOf, truth);
    }

    private static void move(Swimmer swimmer, Settings settings, RandomGenerator random) {
        swimmer.heading = random.nextDouble() < settings.tumble
                ? random.nextDouble(2 * Math.PI)
                : swimmer.heading + 0.05 * random.nextGaussian();
        swimmer.x += swimmer.speed * Math.cos(swimmer.heading);
        swimmer.y += swimmer.speed * Math.sin(swimmer.heading);
        if (swimmer.x < 0 || swimmer.x > settings.width) {
            swimmer.heading = Math.PI - swimmer.heading;
            swimmer.x = Math.max(0, Math.min(settings.width, swimmer.x));
        }
        if (swimmer.y < 0 || swimmer.y > settings.height) {
            swimmer.heading = -swimmer.heading;
            swimmer.y = Math.max(0, Math.min(settings.height, swimmer.y));
        }
        double change = swimmer.inFocus ? settings.leaveFocus : settings.returnToFocus;
        swimmer.inFocus ^= random.nextDouble() < change;
    }

    private static Detection detect(double x, double y, double score, Settings settings, RandomGenerator random) {
        double width = settings.boxSize * (1 + 0.03 * random.nextGaussian());
        double height = settings.boxSize * (1 + 0.03 * random.nextGaussian());
        Level level = Level.values()[random.nextInt(3)];
        return new Detection(Box.around(x, y, width, height), score, level);
    }

    /** As the detector's own suppression does: of two boxes that overlap by more than 0.7, the weaker goes. */
    private static List<Detection> suppressOverlapping(List<Detection> detections) {
        List<Detection> kept = new ArrayList<>();
        detections.stream()
                .sorted(Comparator.comparingDouble(Detection::score).reversed())
                .filter(detection ->
                        kept.stream().noneMatch(other -> other.box().iou(detection.box()) > 0.7))
                .forEach(kept::add);
        return kept;
    }
}
