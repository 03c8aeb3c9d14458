// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.ImagePlus;
import ij.gui.Overlay;
import ij.gui.PolygonRoi;
import ij.gui.Roi;
import java.awt.BasicStroke;
import java.util.List;
import java.util.Optional;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.Box;
import org.memtrack.run.TrackPicture;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.ImageFilm;

/**
 * Tracks over the open film, beside what else is drawn there: in each frame boxes, those of interpolated points dashed, and
 * the last steps behind them; less where tracks have so many points that ImageJ would need much memory.
 */
final class TrackOverlay {
    /** Steps of a track that are shown behind its box, in frames. */
    private static final int TAIL = 20;

    /** Boxes with tails take ImageJ some 1.3 kB a point. */
    static final int MOST_POINTS_WITH_TAILS = 20_000;

    /** Boxes alone take 0.4 kB a point; whole paths 16 bytes, but they hide the film. */
    static final int MOST_POINTS_WITH_BOXES = 100_000;

    /** With the number of the track, the name of what is ours. */
    private static final String NAME = "MEMTrack track ";

    private static final BasicStroke DASHED =
            new BasicStroke(1, BasicStroke.CAP_BUTT, BasicStroke.JOIN_MITER, 1, new float[] {3, 2}, 0);

    private TrackOverlay() {}

    /** Draws tracks in place of those of an earlier run; gives what the user should know of it, one sentence. */
    static Optional<String> show(ImagePlus image, ImageFilm film, List<Track> tracks) {
        Overlay overlay = withoutTracks(image.getOverlay());
        int points = tracks.stream().mapToInt(track -> track.points().size()).sum();
        boolean tails = points <= MOST_POINTS_WITH_TAILS;
        boolean boxes = points <= MOST_POINTS_WITH_BOXES;
        for (Track track : tracks) {
            if (boxes) {
                addBoxes(overlay, image, film, track, tails);
            } else {
                add(overlay, track, path(track.points()));
            }
        }
        image.setOverlay(overlay);
        return tails
                ? Optional.empty()
                : Optional.of(
                        "The tracks have %d points, so %s are drawn over the film: open the .xml in TrackMate to see more."
                                .formatted(
                                        points,
                                        boxes ? "boxes but not the steps behind them" : "whole paths but no boxes"));
    }

    private static Overlay withoutTracks(@Nullable Overlay drawn) {
        Overlay overlay = drawn == null ? new Overlay() : drawn;
        List<Roi> others = Stream.of(overlay.toArray())
                .filter(roi -> roi.getName() == null || !roi.getName().startsWith(NAME))
                .toList();
        overlay.clear();
        others.forEach(overlay::add);
        return overlay;
    }

    private static void addBoxes(Overlay overlay, ImagePlus image, ImageFilm film, Track track, boolean tails) {
        List<TrackPoint> points = track.points();
        for (int i = 0; i < points.size(); i++) {
            int slice = film.sliceOf(points.get(i).frame() - film.firstFrame());
            add(overlay, track, at(image, slice, box(points.get(i))));
            if (tails && i > 0) {
                add(overlay, track, at(image, slice, path(points.subList(Math.max(0, i - TAIL), i + 1))));
            }
        }
    }

    private static Roi box(TrackPoint point) {
        Box box = point.box();
        // ImageJ counts from the corner of a pixel, we from its centre.
        Roi roi = new Roi(box.xMin() + 0.5, box.yMin() + 0.5, box.width(), box.height());
        if (point.interpolated()) {
            roi.setStroke(DASHED);
        }
        return roi;
    }

    private static Roi path(List<TrackPoint> points) {
        float[] x = new float[points.size()];
        float[] y = new float[points.size()];
        for (int i = 0; i < x.length; i++) {
            x[i] = (float) points.get(i).box().centreX() + 0.5f;
            y[i] = (float) points.get(i).box().centreY() + 0.5f;
        }
        return new PolygonRoi(x, y, Roi.POLYLINE);
    }

    private static Roi at(ImagePlus image, int slice, Roi roi) {
        if (image.isHyperStack()) {
            int[] place = image.convertIndexToPosition(slice);
            // Channel 0: seen over every channel.
            roi.setPosition(0, place[1], place[2]);
        } else {
            roi.setPosition(slice);
        }
        return roi;
    }

    private static void add(Overlay overlay, Track track, Roi roi) {
        roi.setStrokeColor(TrackPicture.colour(track.id()));
        roi.setName(NAME + track.id());
        overlay.add(roi);
    }
}
