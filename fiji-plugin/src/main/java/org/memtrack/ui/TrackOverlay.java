// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.ImagePlus;
import ij.gui.Overlay;
import ij.gui.PolygonRoi;
import ij.gui.Roi;
import java.awt.BasicStroke;
import java.util.List;
import org.memtrack.detection.Box;
import org.memtrack.run.TrackPicture;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.ImageFilm;

/** Boxes and the last steps of each track, over the open film; boxes of interpolated points are dashed. */
final class TrackOverlay {
    /** Steps of a track that are shown behind its box, in frames. */
    private static final int TAIL = 20;

    private TrackOverlay() {}

    static void show(ImagePlus image, ImageFilm film, List<Track> tracks) {
        Overlay overlay = new Overlay();
        for (Track track : tracks) {
            for (int i = 0; i < track.points().size(); i++) {
                TrackPoint point = track.points().get(i);
                int slice = film.sliceOf(point.frame() - film.firstFrame());
                add(overlay, image, slice, track, box(point));
                if (i > 0) {
                    add(overlay, image, slice, track, tail(track.points().subList(Math.max(0, i - TAIL), i + 1)));
                }
            }
        }
        image.setOverlay(overlay);
    }

    private static Roi box(TrackPoint point) {
        Box box = point.box();
        // ImageJ counts from the corner of a pixel, we from its centre.
        Roi roi = new Roi(box.xMin() + 0.5, box.yMin() + 0.5, box.width(), box.height());
        if (point.interpolated()) {
            roi.setStroke(new BasicStroke(1, BasicStroke.CAP_BUTT, BasicStroke.JOIN_MITER, 1, new float[] {3, 2}, 0));
        }
        return roi;
    }

    private static Roi tail(List<TrackPoint> points) {
        float[] x = new float[points.size()];
        float[] y = new float[points.size()];
        for (int i = 0; i < x.length; i++) {
            x[i] = (float) points.get(i).box().centreX() + 0.5f;
            y[i] = (float) points.get(i).box().centreY() + 0.5f;
        }
        return new PolygonRoi(x, y, Roi.POLYLINE);
    }

    private static void add(Overlay overlay, ImagePlus image, int slice, Track track, Roi roi) {
        roi.setStrokeColor(TrackPicture.colour(track.id()));
        if (image.isHyperStack()) {
            int[] place = image.convertIndexToPosition(slice);
            // Channel 0: seen over every channel.
            roi.setPosition(0, place[1], place[2]);
        } else {
            roi.setPosition(slice);
        }
        overlay.add(roi);
    }
}
