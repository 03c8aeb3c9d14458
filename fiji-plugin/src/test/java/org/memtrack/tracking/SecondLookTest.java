// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.function.IntFunction;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;

class SecondLookTest {
    private static final int FRAMES = 80;

    private static Detection at(double x, double y, double score) {
        return new Detection(Box.around(x, y, 30, 30), score, Level.LOW);
    }

    private static List<FrameDetections> film(
            IntFunction<List<Detection>> detections, IntFunction<List<Detection>> faint, double driftPerFrame) {
        return IntStream.range(0, FRAMES)
                .mapToObj(frame -> new FrameDetections(
                        frame, detections.apply(frame), driftPerFrame * frame, 0, faint.apply(frame)))
                .toList();
    }

    private static List<Track> track(List<FrameDetections> frames) {
        return new SortTracker(SortSettings.WATER, new Field(660, 492)).track(frames);
    }

    @Test
    void aFaintCellThatTravelsAndIsFoundAgainAndAgainIsTracked() {
        List<FrameDetections> frames = film(frame -> List.of(), frame -> List.of(at(100 + 0.3 * frame, 200, 0.4)), 0);

        List<Track> tracks = track(frames);

        assertThat(tracks).hasSize(1);
        assertThat(tracks.get(0).points()).hasSize(FRAMES);
        assertThat(tracks.get(0).points().get(7).detection())
                .isSameAs(frames.get(7).faint().get(0));
    }

    @ParameterizedTest(name = "{3}")
    @CsvSource({
        "0,   0.9, 80, what stays where it is may be a speck",
        "0.3, 0.3, 80, its score is too low in all frames",
        "0.3, 0.6, 25, it was found too seldom",
    })
    void whatIsNotSureToBeACellIsNot(double speed, double score, int frames, String reason) {
        List<FrameDetections> film = film(
                frame -> List.of(),
                frame -> frame < frames ? List.of(at(100 + speed * frame, 200, score)) : List.of(),
                0);

        assertThat(track(film)).as(reason).isEmpty();
    }

    @Test
    void whatStaysWhereItIsInTheSceneDoesNotTravelWithTheStage() {
        assertThat(track(film(frame -> List.of(), frame -> List.of(at(100 + 0.5 * frame, 200, 0.9)), 0.5)))
                .isEmpty();
    }

    @Test
    void aBoxBesideATrackIsNoCellOfItsOwn() {
        List<Track> tracks = track(
                film(frame -> List.of(at(100 + frame, 200, 0.9)), frame -> List.of(at(108 + frame, 200, 0.6)), 0));

        assertThat(tracks).hasSize(1);
        assertThat(tracks.get(0).points().get(9).detection().score()).isEqualTo(0.9);
    }

    @Test
    void aCellThatIsOnlyNowAndThenSureIsOneTrackOfAllItsBoxes() {
        List<Track> tracks = track(film(
                frame -> frame % 20 == 0 ? List.of(at(100 + frame, 200, 0.7)) : List.of(),
                frame -> frame % 20 == 0 ? List.of() : List.of(at(100 + frame, 200, 0.4)),
                0));

        assertThat(tracks).hasSize(1);
        assertThat(tracks.get(0).points()).noneMatch(TrackPoint::interpolated);
    }

    @Test
    void whoAsksForAScoreOrALengthGetsNoTrackBelowIt() {
        List<FrameDetections> frames = film(frame -> List.of(), frame -> List.of(at(100 + 0.3 * frame, 200, 0.4)), 0);

        for (TrackFilter filter : List.of(new TrackFilter(30, 8, 0.5), new TrackFilter(FRAMES + 1, 8, 0.3))) {
            assertThat(new SortTracker(SortSettings.WATER.with(filter)).track(frames))
                    .isEmpty();
        }
    }

    @Test
    void theTracksOfBothLooksAreInOrderOfTheirFirstFrame() {
        List<Track> tracks = track(film(
                frame -> frame < 10 ? List.of() : List.of(at(300 - frame, 400, 0.8)),
                frame -> List.of(at(100 + frame, 200, 0.4)),
                0));

        assertThat(tracks).extracting(Track::firstFrame).containsExactly(0, 10);
        assertThat(tracks).extracting(Track::id).containsExactly(0, 1);
    }
}
