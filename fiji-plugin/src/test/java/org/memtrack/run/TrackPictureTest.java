// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import static org.assertj.core.api.Assertions.assertThat;

import ij.IJ;
import ij.ImagePlus;
import ij.process.FloatProcessor;
import java.awt.Color;
import java.awt.image.BufferedImage;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.Film;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.ImageFilm;

class TrackPictureTest {
    private final Film film =
            new ImageFilm(new ImagePlus("constant", new FloatProcessor(500, 200)), FilmOptions.DEFAULTS);

    @Test
    void anObservedBoxIsSolidAndAnInterpolatedOneDashed() {
        // The left edges, at twice the size; the corner of pixel (0, 0) is at (-0.5, -0.5).
        assertThat(coloured(picture(true), 201, 101, 140)).isEqualTo(39);
        assertThat(coloured(picture(false), 201, 101, 140)).isBetween(15L, 30L);
    }

    @Test
    void aTrackThatLacksPointsHasTheBoxOfTheLastFrameOrNone() {
        ImagePlus image = IJ.createImage("six frames", "32-bit black", 500, 200, 6);
        image.setDimensions(1, 1, 6);
        Film sixFrames = new ImageFilm(image, FilmOptions.DEFAULTS);
        Track toTheEnd = new Track(0, List.of(observed(1), observed(5)));
        Track toTheOneBefore = new Track(0, List.of(observed(1), observed(4)));

        assertThat(coloured(picture(sixFrames, toTheEnd), 201, 101, 140)).isEqualTo(39);
        assertThat(coloured(picture(sixFrames, toTheOneBefore), 201, 101, 140)).isZero();
    }

    @Test
    void aFilmWithoutTracksIsAPictureToo() {
        BufferedImage picture = TrackPicture.of(film, TrackedFilm.of(film.info(), List.of(), List.of()))
                .image();
        assertThat(picture.getWidth()).isEqualTo(1000);
        assertThat(picture.getRGB(500, 200)).isEqualTo(Color.BLACK.getRGB());
    }

    private BufferedImage picture(boolean observed) {
        TrackPoint point = observed(0);
        return picture(film, new Track(0, List.of(observed ? point : new TrackPoint(0, point.box(), null))));
    }

    private static TrackPoint observed(int frame) {
        Box box = Box.around(120, 75, 40, 50);
        return new TrackPoint(frame, box, new Detection(box, 0.9, Level.LOW));
    }

    private static BufferedImage picture(Film film, Track track) {
        return TrackPicture.of(film, TrackedFilm.of(film.info(), List.of(track), List.of()))
                .image();
    }

    private static long coloured(BufferedImage picture, int x, int fromY, int toY) {
        long count = 0;
        for (int y = fromY + 1; y <= toY; y++) {
            Color colour = new Color(picture.getRGB(x, y));
            if (colour.getRed() + colour.getGreen() + colour.getBlue() > 150) {
                count++;
            }
        }
        return count;
    }
}
