// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;

import ij.IJ;
import ij.ImagePlus;
import ij.gui.Overlay;
import ij.gui.Roi;
import java.util.List;
import java.util.OptionalDouble;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;
import org.memtrack.video.ImageFilm;

class TrackOverlayTest {
    /** Frames 3 and 4 of the image, counted from 0; the second is interpolated. */
    private static final Track TRACK = new Track(
            0,
            List.of(
                    new TrackPoint(
                            3, new Box(9.5, 19.5, 29.5, 59.5), new Detection(new Box(0, 0, 1, 1), 0.9, Level.LOW)),
                    new TrackPoint(4, new Box(10.5, 19.5, 30.5, 59.5), null)));

    @Test
    void boxesLieOnTheSlicesOfTheirFramesAndInterpolatedOnesAreDashed() {
        ImagePlus image = IJ.createImage("avi", "8-bit", 100, 100, 9);
        Overlay overlay = overlay(image, FrameAxis.Z);

        assertThat(overlay.size()).isEqualTo(3);
        Roi observed = overlay.get(0);
        assertThat(observed.getPosition()).isEqualTo(4);
        // ImageJ counts from the corner of a pixel.
        assertThat(observed.getFloatBounds().getX()).isEqualTo(10);
        assertThat(observed.getFloatBounds().getHeight()).isEqualTo(40);
        assertThat(observed.getStroke() == null || observed.getStroke().getDashArray() == null)
                .isTrue();
        Roi interpolated = overlay.get(1);
        assertThat(interpolated.getPosition()).isEqualTo(5);
        assertThat(interpolated.getStroke().getDashArray()).isNotNull();
        assertThat(overlay.get(2).getTypeAsString()).isEqualTo("Polyline");
    }

    @Test
    void framesThatATrackLacksShowNothingOfIt() {
        ImagePlus image = IJ.createImage("film", "8-bit", 100, 100, 9);
        Box box = new Box(9.5, 19.5, 29.5, 59.5);
        Track track = new Track(0, List.of(new TrackPoint(3, box, null), new TrackPoint(6, box, null)));
        Overlay overlay = overlay(image, FrameAxis.Z, track);
        assertThat(overlay.toArray()).extracting(Roi::getPosition).containsExactly(4, 7, 7);
    }

    @Test
    void ofAHyperstackEveryChannelShowsThem() {
        ImagePlus image = IJ.createHyperStack("film", 100, 100, 2, 1, 9, 8);
        image.setOpenAsHyperStack(true);
        Overlay overlay = overlay(image, FrameAxis.T);
        assertThat(overlay.get(0).getCPosition()).isZero();
        assertThat(overlay.get(0).getTPosition()).isEqualTo(4);
    }

    @Test
    void whatElseIsDrawnStaysAndTheTracksOfAnEarlierRunDoNot() {
        ImagePlus image = IJ.createImage("film", "8-bit", 100, 100, 9);
        Roi scaleBar = new Roi(70, 90, 20, 3);
        image.setOverlay(new Overlay(scaleBar));
        overlay(image, FrameAxis.Z);
        Overlay overlay = overlay(image, FrameAxis.Z);
        assertThat(overlay.get(0)).isSameAs(scaleBar);
        assertThat(overlay.size()).isEqualTo(1 + 3);
    }

    @Test
    void theMorePointsThereAreTheLessIsDrawnOfEachAndTheUserIsTold() {
        ImagePlus image = IJ.createImage("film", "8-bit", 100, 100, 10);
        image.setDimensions(1, 1, 10);
        ImageFilm film = new ImageFilm(image, FilmOptions.DEFAULTS);

        List<Track> tracks = tracksOfTenPoints(TrackOverlay.MOST_POINTS_WITH_TAILS / 10);
        assertThat(TrackOverlay.show(image, film, tracks)).isEmpty();
        assertThat(image.getOverlay().size()).isEqualTo(tracks.size() * (10 + 9));

        tracks = tracksOfTenPoints(TrackOverlay.MOST_POINTS_WITH_BOXES / 10);
        assertThat(TrackOverlay.show(image, film, tracks))
                .hasValueSatisfying(note -> assertThat(note).contains("100000 points", "boxes but not the steps"));
        assertThat(image.getOverlay().size()).isEqualTo(tracks.size() * 10);
        assertThat(image.getOverlay().get(9).getPosition()).isEqualTo(10);

        tracks = tracksOfTenPoints(TrackOverlay.MOST_POINTS_WITH_BOXES / 10 + 1);
        assertThat(TrackOverlay.show(image, film, tracks))
                .hasValueSatisfying(note -> assertThat(note).contains("100010 points", "whole paths"));
        assertThat(image.getOverlay().size()).isEqualTo(tracks.size());
        assertThat(image.getOverlay().get(0).getPosition()).isZero();
        assertThat(image.getOverlay().get(0).getFloatBounds().getX()).isEqualTo(10.5);
    }

    private static List<Track> tracksOfTenPoints(int count) {
        List<TrackPoint> points = IntStream.range(0, 10)
                .mapToObj(frame -> new TrackPoint(frame, Box.around(10 + frame, 20, 4, 2), null))
                .toList();
        return IntStream.range(0, count).mapToObj(id -> new Track(id, points)).toList();
    }

    private static Overlay overlay(ImagePlus image, FrameAxis axis) {
        return overlay(image, axis, TRACK);
    }

    private static Overlay overlay(ImagePlus image, FrameAxis axis, Track track) {
        FilmOptions options = new FilmOptions(axis, 1, 2, 8, OptionalDouble.empty(), OptionalDouble.empty());
        TrackOverlay.show(image, new ImageFilm(image, options), List.of(track));
        return image.getOverlay();
    }
}
