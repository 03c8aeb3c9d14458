// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.function.BooleanSupplier;
import java.util.function.DoubleConsumer;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.StageDrift;

/**
 * Joins the detections of a film into tracks: SORT, interpolation and the track length filter (paper sections
 * "Interpolated Tracker" and "Track Length Filter"). What the paper does not have, nor does {@link
 * Interpolation#AUTHORS}: tracks that share a swimmer become one, unsure positions are smoothed, and where the frames hold
 * faint boxes, a second look finds the cells that are among them.
 */
public final class SortTracker {
    private final SortSettings settings;
    private final @Nullable Field field;

    /** For detections of which it is not known where the field ends. */
    public SortTracker(SortSettings settings) {
        this(settings, null);
    }

    /**
     * For the detections of a film.
     *
     * @param field what the film shows; null when not known
     */
    public SortTracker(SortSettings settings, @Nullable Field field) {
        this.settings = settings;
        this.field = field;
    }

    /** Tracks of a film; as {@link #trackAndFilter}, not to be stopped. */
    public List<Track> track(List<FrameDetections> frames) {
        return trackAndFilter(frames, fraction -> {}, () -> false).tracks();
    }

    /**
     * Tracks of a film, and how many the filter dropped.
     *
     * @param frames in ascending order of frame; a frame that is left out counts as one without detections. Detections are
     *     joined by where they stand in the scene, freed of its drift
     * @param progress told the share of the work that is done, in [0, 1]
     * @param cancelled asked once a frame, and once a track that is smoothed
     * @throws CancellationException when {@code cancelled} said so
     * @throws IllegalArgumentException when the frames are not in ascending order
     */
    public FilteredTracks trackAndFilter(
            List<FrameDetections> frames, DoubleConsumer progress, BooleanSupplier cancelled) {
        SceneView scene = new SceneView(new StageDrift(frames));
        boolean ours = settings.interpolation() == Interpolation.FILL_GAPS;
        boolean again = ours && frames.stream().anyMatch(frame -> !frame.faint().isEmpty());
        double share = again ? 0.5 : 1;
        List<List<TrackPoint>> cells = new ArrayList<>();
        int dropped = 0;
        for (List<TrackPoint> found : joined(frames, scene, done -> progress.accept(share * done), cancelled)) {
            List<TrackPoint> points = whole(found);
            if (points.isEmpty()) {
                continue;
            }
            if (settings.filter().keeps(scene.inFilm(points), field)) {
                cells.add(points);
            } else {
                dropped++;
            }
        }
        if (again) {
            List<List<TrackPoint>> accounted = cells.stream().map(scene::inFilm).toList();
            List<FrameDetections> rest = SecondLook.unaccounted(frames, accounted);
            for (List<TrackPoint> found :
                    joined(rest, scene, done -> progress.accept(share + share * done), cancelled)) {
                if (SecondLook.isCell(found, settings.filter().minimumScore())
                        && settings.filter().isLong(found)) {
                    cells.add(whole(found));
                }
            }
        }
        if (ours && settings.association() == Association.MOTION) {
            cells = Twins.joined(cells);
        }
        if (ours && settings.smooth()) {
            cells = smooth(cells, cancelled);
        }
        List<List<TrackPoint>> kept =
                new ArrayList<>(cells.stream().map(scene::inFilm).toList());
        kept.sort(Comparator.comparingInt(points -> points.get(0).frame()));
        List<Track> tracks = new ArrayList<>();
        for (List<TrackPoint> points : kept) {
            tracks.add(new Track(tracks.size(), points));
        }
        return new FilteredTracks(tracks, dropped);
    }

    /**
     * Points of the tracks with as many detections as they need. How the swimmers of a film move and look is known once they
     * are joined: with that they are joined anew, and told apart where they met.
     */
    private List<List<TrackPoint>> joined(
            List<FrameDetections> frames, SceneView scene, DoubleConsumer progress, BooleanSupplier cancelled) {
        double edge = typicalEdge(frames);
        SwimmerModel swimmers = switch (settings.association()) {
            case OVERLAP -> new SwimmerModel(edge, MotionModel.SORT, null);
            case MOTION -> SwimmerModel.usual(edge);
        };
        Sort sort = new Sort(settings, swimmers);
        if (settings.association() == Association.MOTION) {
            step(sort, frames, scene, done -> progress.accept(done / 2), cancelled);
            SwimmerModel told = SwimmerModel.of(sort.tracklets(), edge);
            if (!told.equals(swimmers)) {
                swimmers = told;
                sort = new Sort(settings, swimmers);
                step(sort, frames, scene, done -> progress.accept(0.5 + done / 2), cancelled);
            }
        } else {
            step(sort, frames, scene, progress, cancelled);
        }
        List<List<TrackPoint>> tracks =
                sort.tracklets().stream().map(Tracklet::points).toList();
        if (settings.interpolation() == Interpolation.AUTHORS) {
            return tracks;
        }
        List<List<TrackPoint>> untangled =
                settings.association() == Association.MOTION ? Meetings.untangled(tracks, swimmers) : tracks;
        return untangled.stream()
                .filter(points -> points.size() >= settings.minimumHits())
                .toList();
    }

    private static void step(
            Sort sort,
            List<FrameDetections> frames,
            SceneView scene,
            DoubleConsumer progress,
            BooleanSupplier cancelled) {
        int expected = frames.isEmpty() ? 0 : frames.get(0).frame();
        for (int i = 0; i < frames.size(); i++) {
            FrameDetections frame = frames.get(i);
            if (frame.frame() < expected) {
                throw new IllegalArgumentException(
                        "Frame %d comes after frame %d".formatted(frame.frame(), expected - 1));
            }
            for (; expected < frame.frame(); expected++) {
                stepUnless(cancelled, sort, new FrameDetections(expected, List.of()));
            }
            stepUnless(cancelled, sort, scene.inScene(frame));
            expected++;
            progress.accept((i + 1.0) / frames.size());
        }
    }

    private static List<List<TrackPoint>> smooth(List<List<TrackPoint>> cells, BooleanSupplier cancelled) {
        List<List<TrackPoint>> smooth = new ArrayList<>(cells.size());
        for (List<TrackPoint> points : cells) {
            if (cancelled.getAsBoolean()) {
                throw new CancellationException("Tracking was cancelled");
            }
            smooth.add(Smoothing.smooth(points));
        }
        return smooth;
    }

    private static double typicalEdge(List<FrameDetections> frames) {
        return frames.stream()
                .flatMap(frame -> frame.detections().stream())
                .mapToDouble(detection -> Math.sqrt(detection.box().area()))
                .average()
                .orElse(0);
    }

    private static void stepUnless(BooleanSupplier cancelled, Sort sort, FrameDetections frame) {
        if (cancelled.getAsBoolean()) {
            throw new CancellationException("Tracking was cancelled at frame " + frame.frame());
        }
        sort.step(frame);
    }

    private List<TrackPoint> whole(List<TrackPoint> found) {
        return settings.interpolation() == Interpolation.FILL_GAPS ? GapFilling.fill(found) : found;
    }
}
