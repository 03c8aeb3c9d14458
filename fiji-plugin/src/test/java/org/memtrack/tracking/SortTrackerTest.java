// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import java.util.ArrayList;
import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.testing.RandomWorld;

/** What the tracker makes of detections: tracks, gaps, and what it leaves out; who is who is told in {@link WhoIsWhoTest}. */
class SortTrackerTest {
    private static final int MAXIMUM_AGE = 5;

    private static SortSettings settings(Association association, Interpolation interpolation) {
        return new SortSettings(association, 0.05, MAXIMUM_AGE, 0, interpolation, false, TrackFilter.ofLength(1));
    }

    private static List<Track> track(List<FrameDetections> frames) {
        return new SortTracker(settings(Association.MOTION, Interpolation.FILL_GAPS)).track(frames);
    }

    /** One swimmer that goes 2 px right and 1 px down a frame, seen in these frames. */
    private static List<FrameDetections> swimmerSeenIn(int... frames) {
        return IntStream.of(frames)
                .mapToObj(frame -> new FrameDetections(
                        frame, List.of(new Detection(Box.around(50 + 2 * frame, 20 + frame, 30, 24), 0.9, Level.HIGH))))
                .toList();
    }

    @Test
    void aSwimmerSeenInEveryFrameIsOneTrackOfItsDetections() {
        List<FrameDetections> frames = swimmerSeenIn(0, 1, 2, 3);

        List<Track> tracks = track(frames);

        assertThat(tracks).hasSize(1);
        assertThat(tracks.get(0).points()).hasSize(4);
        assertThat(tracks.get(0).points().get(2).detection())
                .isSameAs(frames.get(2).detections().get(0));
        assertThat(tracks.get(0).points().get(2).box()).isEqualTo(Box.around(54, 22, 30, 24));
    }

    @ParameterizedTest
    @EnumSource(Association.class)
    void aTrackSurvivesAGapOfMaximumAgeFramesWhichIsFilledOnTheWay(Association association) {
        List<Track> tracks = new SortTracker(settings(association, Interpolation.FILL_GAPS))
                .track(swimmerSeenIn(0, 1, 2, 3, 4, 10, 11));

        assertThat(tracks).hasSize(1);
        assertThat(tracks.get(0).points()).hasSize(12);
        TrackPoint filled = tracks.get(0).points().get(7);
        assertThat(filled.interpolated()).isTrue();
        assertThat(filled.box().centreX()).isCloseTo(64, within(0.5));
        assertThat(filled.box().centreY()).isCloseTo(27, within(0.25));
        assertThat(filled.box().width()).isCloseTo(30, within(1e-9));
        assertThat(filled.box().height()).isCloseTo(24, within(1e-9));
    }

    @ParameterizedTest
    @EnumSource(Association.class)
    void aGapOfOneFrameMoreEndsTheTrack(Association association) {
        List<Track> tracks = new SortTracker(settings(association, Interpolation.FILL_GAPS))
                .track(swimmerSeenIn(0, 1, 2, 3, 4, 11, 12));

        assertThat(tracks).hasSize(2);
        assertThat(tracks.get(0).lastFrame()).isEqualTo(4);
        assertThat(tracks.get(1).firstFrame()).isEqualTo(11);
    }

    @Test
    void nothingFollowsTheLastDetectionUnlessTheAuthorsModeIsAskedFor() {
        List<FrameDetections> frames = new ArrayList<>(swimmerSeenIn(0, 1, 2, 3));
        frames.add(new FrameDetections(20, List.of()));

        List<Track> ours = track(frames);
        List<Track> authors = new SortTracker(settings(Association.OVERLAP, Interpolation.AUTHORS)).track(frames);

        assertThat(ours.get(0).lastFrame()).isEqualTo(3);
        assertThat(authors.get(0).lastFrame()).isEqualTo(3 + MAXIMUM_AGE - 1);
        assertThat(authors.get(0).points().get(6).interpolated()).isTrue();
    }

    @Test
    void tracksShorterThanTheLeastLengthAreDropped() {
        SortSettings least = SortSettings.DEFAULTS.with(TrackFilter.ofLength(4));

        assertThat(new SortTracker(least).track(swimmerSeenIn(0, 1, 2))).isEmpty();
        assertThat(new SortTracker(least).track(swimmerSeenIn(0, 1, 3))).hasSize(1);
    }

    @Test
    void whatTheFilterDropsIsCounted() {
        SortSettings least = SortSettings.DEFAULTS.with(TrackFilter.ofLength(4));
        FilteredTracks found = new SortTracker(least)
                .trackAndFilter(swimmerSeenIn(0, 1, 2, 100, 101, 200, 201, 203), f -> {}, () -> false);
        assertThat(found.tracks()).hasSize(1);
        assertThat(found.dropped()).isEqualTo(2);
    }

    @Test
    void tracksOfFewerThanMinimumHitsAreDropped() {
        SortSettings hits = new SortSettings(
                Association.MOTION, 0.05, 25, 3, Interpolation.FILL_GAPS, false, TrackFilter.ofLength(1));

        assertThat(new SortTracker(hits).track(swimmerSeenIn(0, 4))).isEmpty();
        assertThat(new SortTracker(hits).track(swimmerSeenIn(0, 2, 4))).hasSize(1);
    }

    @Test
    void twoSwimmersThatCrossKeepTheirTracks() {
        List<FrameDetections> frames = new ArrayList<>();
        for (int frame = 0; frame < 40; frame++) {
            Detection right = new Detection(Box.around(20 + 3 * frame, 60, 30, 30), 0.9, Level.HIGH);
            Detection left = new Detection(Box.around(137 - 3 * frame, 66, 30, 30), 0.9, Level.HIGH);
            boolean apart = Math.abs(frame - 19.5) > 2; // one box for both while they lie over each other
            frames.add(new FrameDetections(frame, apart ? List.of(right, left) : List.of(right)));
        }

        List<Track> tracks = track(frames);

        assertThat(tracks).hasSize(2);
        for (Track track : tracks) {
            List<TrackPoint> points = track.points();
            double way = points.get(39).box().centreX() - points.get(0).box().centreX();
            assertThat(Math.abs(way)).isCloseTo(117, within(1e-9));
        }
    }

    /**
     * A bright and a dark one that come from both sides, rest over each other and leave upwards and downwards, on a stage
     * that stands still or drifts: only their contrast tells which one leaves where.
     */
    @ParameterizedTest
    @CsvSource({"1, 0", "-1, 0", "1, 0.5", "-1, 0.5"})
    void whoRestsWithAnotherIsToldByItsContrast(int up, double drift) {
        List<FrameDetections> frames = new ArrayList<>();
        for (int frame = 0; frame < 80; frame++) {
            double before = 2 * Math.max(0, 35 - frame);
            double after = 2 * Math.max(0, frame - 45);
            double x = 100 + drift * frame;
            Detection bright =
                    new Detection(Box.around(x - before, 90 - up * after, 30, 30), 0.9, Level.HIGH, 0.3, Double.NaN);
            Detection dark =
                    new Detection(Box.around(x + before, 90 + up * after, 30, 30), 0.9, Level.HIGH, -0.3, Double.NaN);
            boolean apart = before + after > 4; // one box for both while they lie over each other
            Detection together = new Detection(Box.around(x, 90, 30, 30), 0.9, Level.HIGH, 0, Double.NaN);
            // The upper one first, so that their order does not tell either.
            List<Detection> both = up * after > 0 ? List.of(bright, dark) : List.of(dark, bright);
            frames.add(new FrameDetections(frame, apart ? both : List.of(together), drift * frame, 0));
        }

        List<Track> tracks = new SortTracker(SortSettings.DEFAULTS).track(frames);

        assertThat(tracks).hasSize(2);
        for (Track track : tracks) {
            double first = track.points().get(0).detection().contrast();
            double last =
                    track.points().get(track.points().size() - 1).detection().contrast();
            assertThat(last).isEqualTo(first);
        }
    }

    @Test
    void noFramesAndEmptyFramesGiveNoTracks() {
        assertThat(track(List.of())).isEmpty();
        assertThat(track(List.of(new FrameDetections(3, List.of())))).isEmpty();
    }

    @ParameterizedTest
    @EnumSource(Association.class)
    void boxesWithoutSizeAreTracked(Association association) {
        List<FrameDetections> frames = IntStream.range(0, 5)
                .mapToObj(frame -> new FrameDetections(
                        frame, List.of(new Detection(Box.around(5, 7, 0, 0), 1, Level.UNSPECIFIED))))
                .toList();

        List<Track> tracks = new SortTracker(settings(association, Interpolation.FILL_GAPS)).track(frames);

        assertThat(tracks.stream().mapToInt(track -> track.points().size()).sum())
                .isEqualTo(5);
    }

    @Test
    void framesOutOfOrderAreRefused() {
        List<FrameDetections> frames = swimmerSeenIn(4, 3);

        assertThatThrownBy(() -> track(frames))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("Frame 3 comes after frame 4");
    }

    @Test
    void cancellingStopsAtTheNextFrame() {
        List<Double> fractions = new ArrayList<>();

        assertThatThrownBy(() -> new SortTracker(SortSettings.DEFAULTS)
                        .trackAndFilter(swimmerSeenIn(0, 1, 2, 3), fractions::add, () -> fractions.size() == 2))
                .isInstanceOf(CancellationException.class);
        assertThat(fractions).containsExactly(0.125, 0.25);
    }

    @Test
    void cancellingStopsTheSmoothing() {
        SortTracker tracker = new SortTracker(SortSettings.DEFAULTS.with(TrackFilter.ofLength(1)));
        List<FrameDetections> frames = swimmerSeenIn(0, 1, 2, 3);
        AtomicInteger asked = new AtomicInteger();
        tracker.trackAndFilter(frames, fraction -> {}, () -> asked.incrementAndGet() < 0);
        int last = asked.getAndSet(0);
        assertThatThrownBy(() -> tracker.trackAndFilter(frames, fraction -> {}, () -> asked.incrementAndGet() == last))
                .isInstanceOf(CancellationException.class)
                .hasMessage("Tracking was cancelled");
    }

    @ParameterizedTest
    @EnumSource(Association.class)
    void inRandomWorldsNoDetectionIsInTwoTracksAndEveryGapIsFilled(Association association) {
        RandomWorld.Settings crowd = new RandomWorld.Settings(200, 150, 60, 40, 3, 0.1, 20, 1, 0.2, 0.05, 0.2, 4);
        for (int seed = 0; seed < 8; seed++) {
            RandomWorld world = RandomWorld.of(crowd, seed);

            List<Track> tracks = new SortTracker(settings(association, Interpolation.FILL_GAPS)).track(world.frames());

            Set<Detection> seen = Collections.newSetFromMap(new IdentityHashMap<>());
            for (Track track : tracks) {
                List<TrackPoint> points = track.points();
                assertThat(points).hasSize(track.length());
                assertThat(points.get(0).interpolated()).isFalse();
                assertThat(points.get(points.size() - 1).interpolated()).isFalse();
                for (TrackPoint point : points) {
                    if (point.detection() != null) {
                        assertThat(seen.add(point.detection())).isTrue();
                        assertThat(point.box()).isEqualTo(point.detection().box());
                    }
                }
            }
            int all = 0;
            int shared = 0;
            for (FrameDetections frame : world.frames()) {
                all += frame.detections().size();
                for (Detection left : frame.detections()) {
                    if (!seen.contains(left)) {
                        assertThat(frame.detections())
                                .anyMatch(other ->
                                        seen.contains(other) && other.box().distance(left.box()) < 10);
                        shared++;
                    }
                }
            }
            // Of tracks that share a swimmer one box a frame counts; only these are joined so.
            assertThat(shared).isLessThanOrEqualTo(association == Association.MOTION ? all / 100 : 0);
        }
    }

    @ParameterizedTest
    @EnumSource(Association.class)
    void aStageThatJumpsBreaksNoTrack(Association association) {
        List<FrameDetections> frames = new ArrayList<>();
        for (int i = 0; i < 20; i++) {
            double jump = i < 10 ? 0 : 60;
            List<Detection> detections = new ArrayList<>();
            for (int k = 0; k < 3; k++) {
                Box box = Box.around(100 + 45 * k + 0.5 * i + jump, 80 - jump, 30, 30);
                if (i < 9 || i > 10) {
                    detections.add(new Detection(box, 0.9, Level.LOW));
                }
            }
            frames.add(new FrameDetections(i, detections, jump, -jump));
        }

        List<Track> tracks = new SortTracker(settings(association, Interpolation.FILL_GAPS)).track(frames);

        assertThat(tracks).hasSize(3).allMatch(track -> track.length() == 20);
        for (Track track : tracks) {
            double start = track.points().get(0).box().centreX();
            for (TrackPoint point : track.points()) {
                double jump = point.frame() < 10 ? 0 : 60;
                assertThat(point.box().centreX()).isCloseTo(start + 0.5 * point.frame() + jump, within(0.5));
                assertThat(point.box().centreY()).isCloseTo(80 - jump, within(0.5));
                if (point.detection() != null) {
                    assertThat(frames.get(point.frame()).detections()).anyMatch(found -> found == point.detection());
                    assertThat(point.box()).isEqualTo(point.detection().box());
                }
            }
        }
    }
}
