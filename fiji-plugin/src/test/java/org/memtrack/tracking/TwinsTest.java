// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.function.IntPredicate;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;

class TwinsTest {
    private static final int FRAMES = 40;

    /** The track of a swimmer at this height that was found in some frames. */
    private static List<TrackPoint> track(double y, IntPredicate frames) {
        return GapFilling.fill(IntStream.range(0, FRAMES)
                .filter(frames)
                .mapToObj(frame -> new TrackPoint(
                        frame,
                        Box.around(100 + 2 * frame, y, 30, 30),
                        new Detection(Box.around(100 + 2 * frame, y, 30, 30), 0.9, Level.HIGH)))
                .toList());
    }

    @Test
    void tracksThatAreFoundInTurnsOnOneSwimmerAreOneWithAllOfItsBoxes() {
        List<TrackPoint> one = track(200, frame -> frame % 3 != 1);
        List<TrackPoint> other = track(206, frame -> frame % 3 == 1 || frame % 9 == 0);

        List<List<TrackPoint>> joined = Twins.joined(List.of(other, one));

        assertThat(joined).hasSize(1);
        assertThat(joined.get(0)).hasSize(FRAMES).noneMatch(TrackPoint::interpolated);
        assertThat(joined.get(0))
                .containsAll(one.stream().filter(point -> !point.interpolated()).toList());
        assertThat(joined.get(0)).isSortedAccordingTo((a, b) -> Integer.compare(a.frame(), b.frame()));
    }

    @Test
    void threeOnOneSwimmerAreOne() {
        List<List<TrackPoint>> joined = Twins.joined(List.of(
                track(200, frame -> frame % 3 == 0),
                track(204, frame -> frame % 3 == 1),
                track(208, frame -> frame % 3 == 2)));

        assertThat(joined).hasSize(1);
        assertThat(joined.get(0)).hasSize(FRAMES).noneMatch(TrackPoint::interpolated);
    }

    @ParameterizedTest(name = "{3}")
    @CsvSource({
        "212, 1, 40, farther apart than one swimmer's boxes",
        "206, 2, 40, both found in half of the frames",
        "206, 1, 7, together for too short a time to tell",
    })
    void othersStayTwo(double y, int both, int until, String reason) {
        List<TrackPoint> one = track(200, frame -> frame % 4 < 2 || frame >= until);
        List<TrackPoint> other = track(y, frame -> (both == 1 ? frame % 4 >= 2 : frame % 4 < 3) && frame < until);

        assertThat(Twins.joined(List.of(one, other))).as(reason).containsExactly(one, other);
    }

    @ParameterizedTest(name = "faint: {0}")
    @ValueSource(booleans = {false, true})
    void aSwimmerWhoseBoxesAreFoundAtBothEndsInTurnsMakesOneTrack(boolean faint) {
        List<FrameDetections> film = IntStream.range(0, 2 * FRAMES)
                .mapToObj(frame -> {
                    List<Detection> boxes = IntStream.range(0, 2)
                            .filter(end -> frame % 10 == 0 || (frame / 3 + end) % 2 == 0)
                            .mapToObj(end -> new Detection(
                                    Box.around(100 + 0.3 * frame, 200 + 9 * end, 30, 30),
                                    faint ? 0.4 : 0.9,
                                    Level.HIGH))
                            .toList();
                    return new FrameDetections(frame, faint ? List.of() : boxes, 0, 0, faint ? boxes : List.of());
                })
                .toList();

        List<Track> tracks = new SortTracker(SortSettings.WATER, new Field(660, 492)).track(film);

        assertThat(tracks).hasSize(1);
        assertThat(tracks.get(0).points()).hasSize(2 * FRAMES).noneMatch(TrackPoint::interpolated);
    }
}
