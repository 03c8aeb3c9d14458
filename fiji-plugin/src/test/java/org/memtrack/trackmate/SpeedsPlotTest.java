// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import ij.ImagePlus;
import ij.gui.Plot;
import ij.process.ByteProcessor;
import java.util.Arrays;
import java.util.List;
import java.util.OptionalDouble;
import java.util.Random;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;
import org.memtrack.video.ImageFilm;

class SpeedsPlotTest {
    /** Of straight tracks of ten frames at these speeds, pixels a frame. */
    private static Plot plot(double... speeds) {
        List<Track> tracks = IntStream.range(0, speeds.length)
                .mapToObj(id -> track(id, speeds[id], 10))
                .toList();
        return plot(tracks);
    }

    private static Plot plot(List<Track> tracks) {
        ImagePlus image = new ImagePlus("film", new ByteProcessor(100, 80));
        FilmOptions options = new FilmOptions(FrameAxis.T, 1, 1, 0, OptionalDouble.empty(), OptionalDouble.empty());
        ImageFilm film = new ImageFilm(image, options);
        List<String> names = tracks.stream().map(track -> "Track_" + track.id()).toList();
        return MotilityAction.speeds(
                new ModelTracks(TrackedFilm.of(film.info(), tracks, List.of()), film, names, Set.of(), List.of()));
    }

    private static Track track(int id, double speed, int frames) {
        return IntStream.range(0, frames)
                .mapToObj(frame -> {
                    Box box = Box.around(50 + speed * frame, 40, 10, 12);
                    return new TrackPoint(frame, box, new Detection(box, 0.9, Level.LOW));
                })
                .collect(Collectors.collectingAndThen(Collectors.toList(), points -> new Track(id, points)));
    }

    /** Whether bars are drawn; they have the grey of the grid, which takes fewer pixels. */
    private static boolean hasBars(Plot plot) {
        int[] pixels = (int[]) plot.getProcessor().convertToRGB().getPixels();
        return Arrays.stream(pixels)
                        .filter(pixel -> (pixel & 0xffffff) == 0xc0c0c0)
                        .count()
                > 10_000;
    }

    @Test
    void tracksOfOneSpeedAreABarAroundIt() {
        for (double speed : new double[] {0, 0.3, 2}) {
            for (Plot plot : List.of(plot(speed), plot(speed, speed, speed + 1e-9))) {
                assertThat(hasBars(plot)).isTrue();
                double[] limits = plot.getLimits();
                assertThat((limits[0] + limits[1]) / 2).isCloseTo(speed, within(1e-6));
                assertThat(plot.getDataObjectArrays(0)[0][0]).isCloseTo((float) speed, within(1e-6f));
            }
        }
        assertThat(plot(2, 2, 2).getDataObjectArrays(0)[1]).startsWith(3);
    }

    @Test
    void barsOfOneHeightStandOnZero() {
        Plot plot = plot(1.5, 2);
        assertThat(plot.getDataObjectArrays(0)[1]).containsExactly(1, 1);
        assertThat(hasBars(plot)).isTrue();
        assertThat(plot.getLimits()[2]).isZero();
    }

    @Test
    void tracksTooShortForASpeedLeaveThePlotEmpty() {
        Plot plot = plot(List.of(track(0, 2, 3)));
        assertThat(hasBars(plot)).isFalse();
        assertThat(plot.getLimits()).startsWith(0, 1, 0, 1);
    }

    @Test
    void everyTrackIsCounted() {
        Random random = new Random(3);
        for (int tracks = 2; tracks < 40; tracks++) {
            double spread = Math.pow(10, -6 * random.nextDouble());
            double[] speeds = random.doubles(tracks, 2, 2 + spread).toArray();
            float[] counts = plot(speeds).getDataObjectArrays(0)[1];
            assertThat(IntStream.range(0, counts.length)
                            .mapToDouble(bar -> counts[bar])
                            .sum())
                    .as("of %s", Arrays.toString(speeds))
                    .isEqualTo(tracks);
        }
    }
}
