// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayList;
import java.util.List;
import java.util.function.IntToDoubleFunction;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;
import org.memtrack.tracking.Axis.Noise;

class MeetingsTest {
    private static final int FRAMES = 60;
    private static final int MEETING = 30;
    private static final ContrastModel CONTRASTS = new ContrastModel(new Noise(0.001, 0.001, 0, 0.0001, 0), 0, 0.1);
    private static final SwimmerModel SWIMMERS = new SwimmerModel(30, MotionModel.swimmers(30), CONTRASTS);

    /** Swimmers that cross at an angle and look the same. */
    private static final List<TrackPoint> RIGHTWARDS = swimmer(frame -> 2 * frame, frame -> 60, 0.2);

    private static final List<TrackPoint> DOWNWARDS = swimmer(frame -> 60, frame -> 2 * frame, 0.2);

    /** Swimmers that come from both sides, rest for a while, and leave upwards and downwards: either way is as likely. */
    private static final List<TrackPoint> BRIGHT =
            swimmer(frame -> 60 - wayBefore(frame), frame -> 50 - wayAfter(frame), 0.4);

    private static final List<TrackPoint> DARK =
            swimmer(frame -> 60 + wayBefore(frame), frame -> 50 + wayAfter(frame), -0.4);

    private static double wayBefore(int frame) {
        return Math.max(0, MEETING - 8 - frame);
    }

    private static double wayAfter(int frame) {
        return Math.max(0, frame - MEETING - 8);
    }

    private static List<TrackPoint> swimmer(IntToDoubleFunction x, IntToDoubleFunction y, double contrast) {
        return IntStream.range(0, FRAMES)
                .mapToObj(frame -> {
                    Box box = Box.around(x.applyAsDouble(frame), y.applyAsDouble(frame), 30, 30);
                    return new TrackPoint(frame, box, new Detection(box, 0.9, Level.HIGH, contrast, Double.NaN));
                })
                .toList();
    }

    /** The one until a frame, then the other. */
    private static List<TrackPoint> confused(List<TrackPoint> one, List<TrackPoint> other, int from) {
        List<TrackPoint> points = new ArrayList<>(one.subList(0, from));
        points.addAll(other.subList(from, other.size()));
        return points;
    }

    @Test
    void whoCrossesIsToldByItsWay() {
        List<List<TrackPoint>> told = Meetings.untangled(
                List.of(confused(RIGHTWARDS, DOWNWARDS, MEETING), confused(DOWNWARDS, RIGHTWARDS, MEETING)), SWIMMERS);

        assertThat(x(told.get(0), FRAMES - 1)).isEqualTo(2 * (FRAMES - 1));
        assertThat(x(told.get(1), FRAMES - 1)).isEqualTo(60);
    }

    @Test
    void whoRestsWithAnotherIsToldByItsContrast() {
        List<List<TrackPoint>> tracks = List.of(confused(BRIGHT, DARK, MEETING), confused(DARK, BRIGHT, MEETING));

        List<List<TrackPoint>> told = Meetings.untangled(tracks, SWIMMERS);

        assertThat(contrastsAtTheEndsOf(told.get(0))).containsOnly(0.4);
        assertThat(contrastsAtTheEndsOf(told.get(1))).containsOnly(-0.4);
        SwimmerModel withoutContrasts = new SwimmerModel(30, MotionModel.swimmers(30), null);
        assertThat(Meetings.untangled(tracks, withoutContrasts)).isEqualTo(tracks);
    }

    @Test
    void whoWasNotConfusedStays() {
        for (List<List<TrackPoint>> right : List.of(List.of(RIGHTWARDS, DOWNWARDS), List.of(BRIGHT, DARK))) {
            assertThat(Meetings.untangled(right, SWIMMERS)).isEqualTo(right);
        }
    }

    /** Told by contrast were they nearer. */
    @Test
    void whoNeverMeetsStays() {
        List<TrackPoint> above = swimmer(frame -> 2 * frame, frame -> 50 - Math.abs(frame - MEETING), 0.4);
        List<TrackPoint> below = swimmer(frame -> 2 * frame, frame -> 59 + Math.abs(frame - MEETING), -0.4);
        List<List<TrackPoint>> tracks = List.of(confused(above, below, MEETING), confused(below, above, MEETING));

        assertThat(Meetings.untangled(tracks, SWIMMERS)).isEqualTo(tracks);
    }

    /** Confused at the first meeting and again at the second. */
    @Test
    void whoPartsAndMeetsAgainIsToldTwice() {
        IntToDoubleFunction apart = frame -> 6 * Math.abs(Math.sin(Math.PI * frame / 20));
        List<TrackPoint> above = swimmer(frame -> frame, frame -> 50 - apart.applyAsDouble(frame), 0.4);
        List<TrackPoint> below = swimmer(frame -> frame, frame -> 50 + apart.applyAsDouble(frame), -0.4);
        List<TrackPoint> one = confused(confused(above, below, 20), above, 40);
        List<TrackPoint> other = confused(confused(below, above, 20), below, 40);

        List<List<TrackPoint>> told = Meetings.untangled(List.of(one, other), SWIMMERS);

        for (int frame : new int[] {10, 30, 50}) {
            assertThat(told.get(0).get(frame).detection().contrast()).isEqualTo(0.4);
            assertThat(told.get(1).get(frame).detection().contrast()).isEqualTo(-0.4);
        }
    }

    @Test
    void whoIsSeenOnOneSideOnlyStays() {
        List<TrackPoint> begins = confused(RIGHTWARDS, DOWNWARDS, MEETING).subList(MEETING - 4, FRAMES);
        List<List<TrackPoint>> tracks = List.of(begins, confused(DOWNWARDS, RIGHTWARDS, MEETING));

        assertThat(Meetings.untangled(tracks, SWIMMERS)).isEqualTo(tracks);
    }

    /** A third swimmer meets a tail that has just changed hands, of the one or of the other. */
    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void aLaterMeetingIsOfWhoeverIsThereByThen(boolean rightwards) {
        int later = 45;
        List<TrackPoint> met = rightwards ? RIGHTWARDS : DOWNWARDS;
        List<TrackPoint> third = rightwards
                ? swimmer(frame -> 90, frame -> 60 + 2 * (frame - later), 0.2)
                : swimmer(frame -> 60 + 2 * (frame - later), frame -> 90, 0.2);
        List<TrackPoint> first = confused(RIGHTWARDS, DOWNWARDS, MEETING);
        List<TrackPoint> second = confused(DOWNWARDS, RIGHTWARDS, MEETING);

        List<List<TrackPoint>> told = Meetings.untangled(
                List.of(
                        rightwards ? first : confused(first, third, later),
                        rightwards ? confused(second, third, later) : second,
                        confused(third, met, later)),
                SWIMMERS);

        List<List<TrackPoint>> right = List.of(RIGHTWARDS, DOWNWARDS, third);
        for (int i = 0; i < right.size(); i++) {
            assertThat(told.get(i).get(FRAMES - 1)).isEqualTo(right.get(i).get(FRAMES - 1));
        }
    }

    @Test
    void everyPointIsKeptOnceAndInOrder() {
        List<TrackPoint> first = confused(RIGHTWARDS, DOWNWARDS, MEETING);
        List<TrackPoint> second = confused(DOWNWARDS, RIGHTWARDS, MEETING);

        List<List<TrackPoint>> told = Meetings.untangled(List.of(first, second), SWIMMERS);

        List<TrackPoint> before = new ArrayList<>(first);
        before.addAll(second);
        List<TrackPoint> after = new ArrayList<>(told.get(0));
        after.addAll(told.get(1));
        assertThat(after).containsExactlyInAnyOrderElementsOf(before);
        told.forEach(points ->
                assertThat(points).extracting(TrackPoint::frame).isSorted().doesNotHaveDuplicates());
    }

    private static double x(List<TrackPoint> points, int frame) {
        return points.get(frame).box().centreX();
    }

    private static List<Double> contrastsAtTheEndsOf(List<TrackPoint> points) {
        return List.of(
                points.get(0).detection().contrast(),
                points.get(points.size() - 1).detection().contrast());
    }
}
