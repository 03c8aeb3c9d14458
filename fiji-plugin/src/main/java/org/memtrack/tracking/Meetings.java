// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.Collections;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.IntStream;
import org.memtrack.detection.Box;

/**
 * Swimmers that meet, told apart by how they move and look before and after: where one of them overlaps the other, what SORT
 * decides frame by frame is often a guess.
 *
 * <p>All constants were chosen on simulated films of their own.
 */
final class Meetings {
    /** Two swimmers meet where their centres are this near, as a share of a box's edge: less, and one box is found. */
    private static final double NEAR = 8 / 30.0;

    /** Frames between which they may be farther apart in one meeting. */
    private static final int LONGEST_BREAK = 3;

    /** Frames before and after that are looked at. */
    private static final int VIEW = 15;

    /** Least number of points there. */
    private static final int LEAST_POINTS = 3;

    /** How much less exact the centres beside a meeting are, as a multiple of the variance of other centres. */
    private static final double DISTURBED = 2;

    /** Most that contrasts speak against a way. */
    private static final double MOST_OF_CONTRAST = 4;

    /** Tracks are exchanged where that is so much likelier, as a logarithm. */
    private static final double LEAST_GAIN = 2;

    private final SwimmerModel swimmers;

    /** Two tracks, by number, the first one smaller, that are near each other in these frames, nearest in one of them. */
    private record Meeting(int first, int second, int begin, int end, int nearest, double distance) {
        Meeting and(Meeting later) {
            Meeting nearer = later.distance < distance ? later : this;
            return new Meeting(first, second, begin, later.end, nearer.nearest, nearer.distance);
        }
    }

    /** What is known of a swimmer at a meeting, from before it or, backwards, from after it. */
    private record Side(BoxState state, int frame, double contrast, int contrasts) {}

    private Meetings(SwimmerModel swimmers) {
        this.swimmers = swimmers;
    }

    /**
     * The tracks with the rest of two exchanged wherever they seem to have been confused.
     *
     * @param tracks what was found of each swimmer, in the scene, in order of frame, at least one point
     */
    static List<List<TrackPoint>> untangled(List<List<TrackPoint>> tracks, SwimmerModel swimmers) {
        Meetings meetings = new Meetings(swimmers);
        List<List<TrackPoint>> untangled = new ArrayList<>(tracks);
        // By the number of the track it was, the track that the present piece belongs to.
        int[] now = IntStream.range(0, tracks.size()).toArray();
        for (Meeting meeting : meetings.of(tracks)) {
            int first = now[meeting.first];
            int second = now[meeting.second];
            List<TrackPoint> one = untangled.get(first);
            List<TrackPoint> other = untangled.get(second);
            if (meetings.gainOfExchange(one, other, meeting) > LEAST_GAIN) {
                untangled.set(first, spliced(one, other, meeting.nearest));
                untangled.set(second, spliced(other, one, meeting.nearest));
                now[meeting.first] = second;
                now[meeting.second] = first;
            }
        }
        return untangled;
    }

    private static List<TrackPoint> spliced(List<TrackPoint> head, List<TrackPoint> tail, int lastOfHead) {
        List<TrackPoint> points = new ArrayList<>(head.subList(0, indexFrom(head, lastOfHead + 1)));
        points.addAll(tail.subList(indexFrom(tail, lastOfHead + 1), tail.size()));
        return points;
    }

    private static List<TrackPoint> within(List<TrackPoint> points, int first, int last) {
        return points.subList(indexFrom(points, first), indexFrom(points, last + 1));
    }

    /** Index of the first point that is not before a frame. */
    private static int indexFrom(List<TrackPoint> points, int frame) {
        int low = 0;
        int high = points.size();
        while (low < high) {
            int middle = (low + high) >>> 1;
            if (points.get(middle).frame() < frame) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low;
    }

    /** Logarithm of how much likelier the two were confused; 0 where one of them begins or ends. */
    private double gainOfExchange(List<TrackPoint> one, List<TrackPoint> other, Meeting meeting) {
        List<TrackPoint> oneBefore = within(one, meeting.begin - VIEW, meeting.begin - 1);
        List<TrackPoint> otherBefore = within(other, meeting.begin - VIEW, meeting.begin - 1);
        List<TrackPoint> oneAfter = backwards(within(one, meeting.end + 1, meeting.end + VIEW));
        List<TrackPoint> otherAfter = backwards(within(other, meeting.end + 1, meeting.end + VIEW));
        int least =
                Math.min(Math.min(oneBefore.size(), otherBefore.size()), Math.min(oneAfter.size(), otherAfter.size()));
        if (least < LEAST_POINTS) {
            return 0;
        }
        Side a = side(oneBefore, otherBefore);
        Side b = side(otherBefore, oneBefore);
        Side c = side(oneAfter, otherAfter);
        Side d = side(otherAfter, oneAfter);
        return likelihood(a, d) + likelihood(b, c) - likelihood(a, c) - likelihood(b, d);
    }

    private static List<TrackPoint> backwards(List<TrackPoint> points) {
        List<TrackPoint> reversed = new ArrayList<>(points);
        Collections.reverse(reversed);
        return reversed;
    }

    /** What the points tell, the last of them nearest to the meeting. */
    private Side side(List<TrackPoint> points, List<TrackPoint> ofOther) {
        BoxState state = BoxState.start(points.get(0).box(), swimmers.motion());
        for (int i = 1; i < points.size(); i++) {
            int frames = Math.abs(points.get(i).frame() - points.get(i - 1).frame());
            state = predicted(state, frames).update(points.get(i).box(), swimmers.motion());
        }
        Map<Integer, Box> others = new HashMap<>();
        ofOther.forEach(point -> others.put(point.frame(), point.box()));
        List<TrackPoint> apart = points.stream()
                .filter(point -> !others.containsKey(point.frame())
                        || point.box().distance(others.get(point.frame())) >= ContrastModel.APART * swimmers.edge())
                .toList();
        List<TrackPoint> seen = apart.size() < LEAST_POINTS ? points : apart;
        double contrast = seen.stream()
                .mapToDouble(point -> point.detection().contrast())
                .average()
                .orElseThrow();
        return new Side(state, points.get(points.size() - 1).frame(), contrast, seen.size());
    }

    private BoxState predicted(BoxState state, int frames) {
        BoxState later = state;
        for (int i = 0; i < frames; i++) {
            later = later.predict(swimmers.motion());
        }
        return later;
    }

    /** Logarithm of how likely the swimmer from before is the one from after, but for what is the same for all. */
    private double likelihood(Side before, Side after) {
        MotionModel motion = swimmers.motion();
        int frames = after.frame - before.frame;
        double error = motion.position().measurement();
        BoxState run = predicted(before.state, frames);
        double ran = likelihood(run.x(), after.state.x(), DISTURBED * error)
                + likelihood(run.y(), after.state.y(), DISTURBED * error);
        // Tumbled: as fast as before and after, but anywhere within its reach, in any direction.
        double speed = Math.min(
                motion.position().startVelocity(), 0.1 + (speedSquared(before.state) + speedSquared(after.state)) / 4);
        double reach = (2 + DISTURBED) * error + MotionAssociation.TUMBLE_SPREAD * speed * frames * frames;
        double tumbled = logNormal(after.state.x().value() - before.state.x().value(), reach)
                + logNormal(after.state.y().value() - before.state.y().value(), reach)
                + logNormal(after.state.x().velocity(), speed)
                + logNormal(after.state.y().velocity(), speed);
        double share = 1 - Math.pow(1 - motion.tumble(), frames + 2);
        return Math.log((1 - share) * Math.exp(ran) + share * Math.exp(tumbled) + Double.MIN_NORMAL)
                - surpriseOfContrast(before, after, frames);
    }

    /** How likely a coordinate and its velocity, predicted, are those that are known, backwards, from after it. */
    private static double likelihood(Axis predicted, Axis backwards, double error) {
        double a = predicted.variance() + backwards.variance() + error;
        double b = predicted.covariance() - backwards.covariance();
        double c = predicted.velocityVariance() + backwards.velocityVariance();
        double way = predicted.value() - backwards.value();
        double turn = predicted.velocity() + backwards.velocity();
        double determinant = a * c - b * b;
        double distance = (way * way * c - 2 * way * turn * b + turn * turn * a) / determinant;
        return -distance / 2 - Math.log(2 * Math.PI * Math.sqrt(determinant));
    }

    private double surpriseOfContrast(Side before, Side after, int frames) {
        ContrastModel model = swimmers.contrast();
        if (model == null) {
            return 0;
        }
        double variance = model.noise().measurement() * (1.0 / before.contrasts + 1.0 / after.contrasts)
                + model.noise().step() * (frames + (before.contrasts + after.contrasts) / 3.0);
        double change = after.contrast - before.contrast;
        return Math.min(MOST_OF_CONTRAST, change * change / (2 * variance));
    }

    private static double speedSquared(BoxState state) {
        return state.x().velocity() * state.x().velocity()
                + state.y().velocity() * state.y().velocity();
    }

    private static double logNormal(double difference, double variance) {
        return -difference * difference / (2 * variance) - Math.log(2 * Math.PI * variance) / 2;
    }

    /** All meetings, in the order in which they end. */
    private List<Meeting> of(List<List<TrackPoint>> tracks) {
        /** A track's place in a frame, found or not. */
        record Place(int track, Box box) {}
        Map<Integer, List<Place>> frames = new TreeMap<>();
        for (int i = 0; i < tracks.size(); i++) {
            for (TrackPoint point : GapFilling.fill(tracks.get(i))) {
                frames.computeIfAbsent(point.frame(), frame -> new ArrayList<>())
                        .add(new Place(i, point.box()));
            }
        }
        double reach = NEAR * swimmers.edge();
        Map<List<Integer>, List<Meeting>> ofPairs = new HashMap<>();
        frames.forEach((frame, places) -> {
            places.sort(Comparator.comparingDouble(place -> place.box.centreX()));
            for (int i = 0; i < places.size(); i++) {
                Place one = places.get(i);
                for (int j = i + 1; j < places.size() && places.get(j).box.centreX() - one.box.centreX() < reach; j++) {
                    Place other = places.get(j);
                    double distance = one.box.distance(other.box);
                    if (distance < reach) {
                        int first = Math.min(one.track, other.track);
                        int second = Math.max(one.track, other.track);
                        add(
                                new Meeting(first, second, frame, frame, frame, distance),
                                ofPairs.computeIfAbsent(List.of(first, second), pair -> new ArrayList<>()));
                    }
                }
            }
        });
        return ofPairs.values().stream()
                .flatMap(List::stream)
                .sorted(Comparator.comparingInt(Meeting::end)
                        .thenComparingInt(Meeting::first)
                        .thenComparingInt(Meeting::second))
                .toList();
    }

    /** Adds a frame to the last meeting of two, or begins a new one. */
    private static void add(Meeting frame, List<Meeting> before) {
        Meeting last = before.isEmpty() ? null : before.get(before.size() - 1);
        if (last == null || frame.begin - last.end > LONGEST_BREAK + 1) {
            before.add(frame);
        } else {
            before.set(before.size() - 1, last.and(frame));
        }
    }
}
