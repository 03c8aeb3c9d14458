// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import ij.ImagePlus;
import ij.measure.Calibration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Map;
import java.util.NavigableSet;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.detection.StageDrift;
import org.memtrack.formats.SpotFeature;

/** The observed spots of a collection as detections, in pixels, and the way back. */
final class SpotFilm {
    private final SpotCollection spots;
    private final double pixelWidth;
    private final double pixelHeight;
    private final StageDrift drift;
    private final Map<Detection, Spot> spotOf = new IdentityHashMap<>();
    private final List<FrameDetections> frames = new ArrayList<>();
    private final List<Spot> interpolated = new ArrayList<>();
    private double interval = Double.NaN;
    private boolean boxed;

    private SpotFilm(SpotCollection spots, double pixelWidth, double pixelHeight) {
        this.spots = spots;
        this.pixelWidth = pixelWidth;
        this.pixelHeight = pixelHeight;
        this.drift = new StageDrift(SpotDrift.of(spots, pixelWidth, pixelHeight));
    }

    /**
     * Takes the visible spots.
     *
     * @param image whose pixel size the spots were made with; without it, spots count as given in pixels
     */
    static SpotFilm of(SpotCollection spots, @Nullable ImagePlus image) {
        Calibration calibration = image == null ? new Calibration() : image.getCalibration();
        SpotFilm film = new SpotFilm(spots, calibration.pixelWidth, calibration.pixelHeight);
        NavigableSet<Integer> frames = spots.keySet();
        for (int frame : frames) {
            film.take(frame, spots.iterable(frame, false));
        }
        if (Double.isNaN(film.interval)) {
            film.interval = calibration.frameInterval > 0 ? calibration.frameInterval : 1;
        }
        return film;
    }

    private void take(int frame, Iterable<Spot> all) {
        List<Detection> detections = new ArrayList<>();
        for (Spot spot : all) {
            if (Spots.interpolated(spot)) {
                interpolated.add(spot);
                continue;
            }
            spot.putFeature(SpotFeature.INTERPOLATED.key(), 0.0);
            boxed |= Spots.hasBox(spot);
            double time = Spots.value(spot, Spot.POSITION_T, Double.NaN);
            if (frame > 0 && time > 0) {
                interval = time / frame;
            }
            if (Spots.value(spot, SpotCollection.VISIBILITY, 1) > 0) {
                Detection detection = new Detection(
                        Spots.box(spot, pixelWidth, pixelHeight),
                        Spots.value(spot, Spot.QUALITY, 0),
                        SpotFeature.levelOf(Spots.value(spot, SpotFeature.LEVEL.key(), 0)),
                        Spots.value(spot, SpotFeature.CONTRAST.key(), Double.NaN),
                        Spots.value(spot, SpotFeature.POSITION_ERROR.key(), Double.NaN) / pixelWidth);
                spotOf.put(detection, spot);
                detections.add(detection);
            }
        }
        frames.add(new FrameDetections(frame, detections, drift.x(frame), drift.y(frame)));
    }

    List<FrameDetections> frames() {
        return frames;
    }

    /** Whether any spot has the score of a MEMTrack detector. */
    boolean hasScores() {
        return spotOf.keySet().stream().anyMatch(detection -> detection.level() != Level.UNSPECIFIED);
    }

    /** The spot that became a detection; by identity, two spots may be equal. */
    Spot spotOf(Detection detection) {
        Spot spot = spotOf.get(detection);
        if (spot == null) {
            throw new IllegalArgumentException("Not a detection of this film: " + detection);
        }
        return spot;
    }

    Collection<Spot> observed() {
        return spotOf.values();
    }

    /** Takes out what an earlier run interpolated. */
    void removeInterpolated() {
        interpolated.forEach(spot -> spots.remove(spot, Spots.frame(spot)));
    }

    /** A spot, not in the collection yet, where no detection is; its quality is 0, since nothing was seen, and it has a box where others do. */
    Spot interpolate(int frame, Box box) {
        double width = box.width() * pixelWidth;
        double height = box.height() * pixelHeight;
        Spot spot = Spots.at(box.centreX() * pixelWidth, box.centreY() * pixelHeight, (width + height) / 4, 0);
        spot.putFeature(Spot.FRAME, (double) frame);
        spot.putFeature(Spot.POSITION_T, frame * interval);
        spot.putFeature(SpotFeature.INTERPOLATED.key(), 1.0);
        if (boxed) {
            spot.putFeature(SpotFeature.BOX_WIDTH.key(), width);
            spot.putFeature(SpotFeature.BOX_HEIGHT.key(), height);
        }
        SpotDrift.put(spot, drift.x(frame) * pixelWidth, drift.y(frame) * pixelHeight);
        return spot;
    }
}
