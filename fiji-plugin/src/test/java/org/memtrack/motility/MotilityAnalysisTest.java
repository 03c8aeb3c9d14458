// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.Random;
import java.util.function.IntToDoubleFunction;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.detection.StageDrift;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmInfo;

class MotilityAnalysisTest {
    /** Pixel size and frame rate of the paper's films. */
    private static final FilmInfo FILM = new FilmInfo(
            "film", Optional.empty(), 660, 492, 600, OptionalDouble.of(0.2475), OptionalDouble.of(1 / 60.0));

    private static final FilmInfo UNCALIBRATED =
            new FilmInfo("film", Optional.empty(), 660, 492, 600, OptionalDouble.empty(), OptionalDouble.empty());

    private static Track track(int frames, IntToDoubleFunction x, IntToDoubleFunction y) {
        List<TrackPoint> points = new ArrayList<>();
        for (int frame = 0; frame < frames; frame++) {
            Box box = Box.around(x.applyAsDouble(frame), y.applyAsDouble(frame), 30, 30);
            points.add(new TrackPoint(frame, box, new Detection(box, 0.9, Level.LOW)));
        }
        return new Track(4, points);
    }

    private static TrackMotility analyse(FilmInfo film, Track track) {
        return MotilityAnalysis.analyse(film, List.of(track), new StageDrift(List.of()))
                .get(0);
    }

    @Test
    void aStraightSwimmerHasItsSpeedAndTheDiffusivityOfTheLongestLag() {
        Track swimmer = track(61, frame -> 3 + 0.6 * frame, frame -> 5 + 0.8 * frame);

        TrackMotility motility = analyse(FILM, swimmer);

        assertThat(motility.trackId()).isEqualTo(4);
        assertThat(motility.meanSpeedPixelsPerFrame().getAsDouble()).isCloseTo(1, within(1e-9));
        assertThat(motility.meanSpeed().getAsDouble()).isCloseTo(0.2475 * 60, within(1e-9));
        assertThat(motility.lagFrames()).isEqualTo(6);
        assertThat(motility.lagSpeed().getAsDouble()).isCloseTo(0.2475 * 60, within(1e-9));
        // Half a track of 60 frames is 0.5 s; (v tau)^2 / (4 tau).
        double speed = 0.2475 * 60;
        assertThat(motility.peakDiffusivity().getAsDouble()).isCloseTo(speed * speed * 0.5 / 4, within(1e-6));
        assertThat(motility.motilityClass()).contains(MotilityClass.HIGH);
    }

    @ParameterizedTest
    @CsvSource({"0.02, NONE", "0.15, LOW", "0.55, MEDIUM", "2.5, HIGH"})
    void aRandomWalkHasTheClassOfItsDiffusivityInSpiteOfErrorsOfPosition(double diffusivity, MotilityClass expected) {
        int right = 0;
        Random random = new Random(11);
        for (int i = 0; i < 50; i++) {
            double step = Math.sqrt(2 * diffusivity / 60) / 0.2475;
            double[] xy = {100, 100};
            List<TrackPoint> points = new ArrayList<>();
            for (int frame = 0; frame < 300; frame++) {
                xy[0] += step * random.nextGaussian();
                xy[1] += step * random.nextGaussian();
                Box box = Box.around(xy[0] + 0.3 * random.nextGaussian(), xy[1] + 0.3 * random.nextGaussian(), 30, 30);
                points.add(new TrackPoint(frame, box, new Detection(box, 0.9, Level.LOW)));
            }
            if (analyse(FILM, new Track(i, points)).motilityClass().orElseThrow() == expected) {
                right++;
            }
        }
        assertThat(right).isGreaterThanOrEqualTo(35);
    }

    @Test
    void aRestingBacteriumIsOfNoMotilityThoughItsPositionJitters() {
        Random random = new Random(2);
        Track jitter = track(120, frame -> 50 + 0.4 * random.nextGaussian(), frame -> 70 + 0.4 * random.nextGaussian());

        assertThat(analyse(FILM, jitter).motilityClass()).contains(MotilityClass.NONE);
    }

    @Test
    void theDriftOfTheSceneIsNoMotion() {
        Track carried = track(61, frame -> 50 + 0.5 * frame, frame -> 70 - 0.25 * frame);
        List<FrameDetections> drift = new ArrayList<>();
        for (int frame = 0; frame < 61; frame++) {
            drift.add(new FrameDetections(frame, List.of(), 0.5 * frame, -0.25 * frame));
        }

        TrackMotility motility = MotilityAnalysis.analyse(FILM, List.of(carried), new StageDrift(drift))
                .get(0);

        assertThat(motility.meanSpeedPixelsPerFrame().getAsDouble()).isCloseTo(0, within(1e-9));
        assertThat(motility.motilityClass()).contains(MotilityClass.NONE);
    }

    @Test
    void withoutCalibrationSpeedsArePixelsAFrameAndThereIsNoClass() {
        TrackMotility motility = analyse(UNCALIBRATED, track(61, frame -> 3.0 * frame, frame -> 9));

        assertThat(motility.meanSpeedPixelsPerFrame().getAsDouble()).isCloseTo(3, within(1e-9));
        assertThat(motility.lagSpeedPixelsPerFrame().getAsDouble()).isCloseTo(3, within(1e-9));
        assertThat(motility.meanSpeed()).isEmpty();
        assertThat(motility.lagSpeed()).isEmpty();
        assertThat(motility.peakDiffusivity()).isEmpty();
        assertThat(motility.motilityClass()).isEmpty();
    }

    @Test
    void oneDetectionHasNoSpeedAndNoClass() {
        TrackMotility motility = analyse(FILM, track(1, frame -> 3, frame -> 9));

        assertThat(motility.meanSpeedPixelsPerFrame()).isEmpty();
        assertThat(motility.meanSpeed()).isEmpty();
        assertThat(motility.lagSpeed()).isEmpty();
        assertThat(motility.motilityClass()).isEmpty();
    }

    @Test
    void interpolatedPointsCountForTimeButNotForTheWay() {
        Box start = Box.around(10, 20, 30, 30);
        Box detour = Box.around(90, 90, 30, 30);
        Box end = Box.around(14, 20, 30, 30);
        Track track = new Track(
                0,
                List.of(
                        new TrackPoint(0, start, new Detection(start, 1, Level.LOW)),
                        new TrackPoint(1, detour, null),
                        new TrackPoint(2, end, new Detection(end, 1, Level.LOW))));

        assertThat(analyse(FILM, track).meanSpeedPixelsPerFrame().getAsDouble()).isCloseTo(2, within(1e-9));
    }

    @ParameterizedTest
    @CsvSource({"0, NONE", "0.075, NONE", "0.0751, LOW", "0.25, LOW", "1, MEDIUM", "1.0001, HIGH", "1e9, HIGH"})
    void classesEndWhereThePaperSays(double diffusivity, MotilityClass expected) {
        assertThat(MotilityClass.of(diffusivity)).isEqualTo(expected);
    }

    @Test
    void aDiffusivityThatCannotBeIsRefused() {
        assertThatThrownBy(() -> MotilityClass.of(Double.NaN)).isInstanceOf(IllegalArgumentException.class);
        assertThatThrownBy(() -> MotilityClass.of(-0.1)).isInstanceOf(IllegalArgumentException.class);
    }
}
