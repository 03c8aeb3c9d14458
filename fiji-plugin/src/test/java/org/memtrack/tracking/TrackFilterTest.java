// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;

class TrackFilterTest {
    private static final Field FIELD = new Field(200, 100);
    private static final TrackFilter FILTER = new TrackFilter(10, 5, 0.4);

    @Test
    void aTrackIsLongEnoughInTheMiddleWithTheFullLengthAndAtTheEdgeWithLess() {
        assertThat(FILTER.keeps(track(10, 100, 0, 0.8, Level.LOW), FIELD)).isTrue();
        assertThat(FILTER.keeps(track(9, 100, 0, 0.8, Level.LOW), FIELD)).isFalse();
        assertThat(FILTER.keeps(track(5, 14, 0, 0.8, Level.LOW), FIELD)).isTrue();
        assertThat(FILTER.keeps(track(5, 172, 4, 0.8, Level.LOW), FIELD)).isTrue();
        assertThat(FILTER.keeps(track(5, 168, 0, 0.8, Level.LOW), FIELD)).isFalse();
        assertThat(FILTER.keeps(track(4, 14, 0, 0.8, Level.LOW), FIELD)).isFalse();
    }

    @Test
    void aShortTrackWhoseMeanScoreIsHighIsKept() {
        assertThat(FILTER.keeps(track(5, 100, 0, 0.91, Level.LOW), FIELD)).isTrue();
        assertThat(FILTER.keeps(track(5, 100, 0, 0.91, Level.LOW), null)).isTrue();
        assertThat(FILTER.keeps(track(4, 100, 0, 0.91, Level.LOW), FIELD)).isFalse();
        assertThat(FILTER.keeps(track(9, 100, 0, 0.89, Level.LOW), FIELD)).isFalse();
        assertThat(FILTER.keeps(seenEvery(2, 9, 1), FIELD)).isFalse();
    }

    @Test
    void aShortTrackAtTheEdgeNeedsTheLeastScoreToo() {
        assertThat(FILTER.keeps(track(5, 14, 0, 0.41, Level.LOW), FIELD)).isTrue();
        assertThat(FILTER.keeps(track(5, 14, 0, 0.39, Level.LOW), FIELD)).isFalse();
    }

    @Test
    void noPlaceMakesATrackSureWhenTheFieldIsNotKnown() {
        assertThat(FILTER.keeps(track(9, 14, 0, 0.8, Level.LOW), null)).isFalse();
        assertThat(FILTER.keeps(track(10, 14, 0, 0.8, Level.LOW), null)).isTrue();
    }

    @Test
    void aLengthOfItsOwnHoldsForSureTracksToo() {
        assertThat(TrackFilter.ofLength(10).keeps(track(9, 14, 0, 1, Level.LOW), FIELD))
                .isFalse();
        assertThat(new TrackFilter(5, 10, 0).keeps(track(5, 14, 0, 1, Level.LOW), FIELD))
                .isTrue();
    }

    @Test
    void oursAsksAQuarterOfTheLengthOfSureTracksRoundedUp() {
        assertThat(TrackFilter.ofSwimmers(60)).isEqualTo(new TrackFilter(60, 15, 0.3));
        assertThat(TrackFilter.ofSwimmers(30)).isEqualTo(new TrackFilter(30, 8, 0.3));
        assertThat(TrackFilter.ofSwimmers(1)).isEqualTo(new TrackFilter(1, 1, 0.3));
    }

    @Test
    void framesWithoutADetectionCountAgainstATrack() {
        assertThat(FILTER.keeps(track(20, 100, 0, 0.41, Level.HIGH), FIELD)).isTrue();
        assertThat(FILTER.keeps(track(20, 100, 0, 0.39, Level.HIGH), FIELD)).isFalse();
        assertThat(FILTER.keeps(seenEvery(2, 21, 0.9), FIELD)).isTrue();
        assertThat(FILTER.keeps(seenEvery(4, 21, 0.9), FIELD)).isFalse();
    }

    @Test
    void scoresOfOtherDetectorsAreNotAsked() {
        assertThat(FILTER.keeps(track(10, 100, 0, 0.01, Level.UNSPECIFIED), FIELD))
                .isTrue();
        assertThat(FILTER.keeps(track(9, 100, 0, 1, Level.UNSPECIFIED), FIELD)).isFalse();
        assertThat(FILTER.keeps(track(5, 14, 0, 0.01, Level.UNSPECIFIED), FIELD))
                .isTrue();
    }

    private static List<TrackPoint> track(int frames, double x, double step, double score, Level level) {
        List<TrackPoint> points = new ArrayList<>();
        for (int i = 0; i < frames; i++) {
            Box box = Box.around(x + i * step, 50, 30, 30);
            points.add(new TrackPoint(i, box, new Detection(box, score, level)));
        }
        return points;
    }

    private static List<TrackPoint> seenEvery(int period, int frames, double score) {
        List<TrackPoint> points = track(frames, 100, 0, score, Level.LOW);
        points.replaceAll(
                point -> point.frame() % period == 0 ? point : new TrackPoint(point.frame(), point.box(), null));
        return points;
    }
}
