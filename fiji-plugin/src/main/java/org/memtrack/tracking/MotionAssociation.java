// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.tracking.Matching.Pair;

/**
 * Association by likelihood: a swimmer either ran on, and is where the Kalman filter predicts, or it tumbled since its last
 * detection, and is anywhere as near to that as its speed allows.
 *
 * <p>The gain of a match is the logarithm of that density over the density of new swimmers and false alarms; a match worth
 * less than nothing is not made, which is the gate. Where several matches pass it, contrasts have a say in which is made.
 *
 * @param swimmers how those of the film move and look
 */
record MotionAssociation(SwimmerModel swimmers) implements Associator {
    /** New swimmers and false alarms, a pixel^2 and frame: 3 in a frame of 660 x 492. */
    private static final double NEW_DENSITY = 1e-5;

    /** How much less likely a swimmer comes back with each frame it was missing, as a logarithm. */
    private static final double FORGETTING = 0.1;

    /** Variance of the way since the last detection after a tumble, as a share of (start speed x frames)^2. */
    static final double TUMBLE_SPREAD = 0.7;

    /** What a match is worth at least that passes the gate, whatever its contrast says. */
    private static final double LEAST_GAIN = 0.01;

    /** Where a tracklet may be: a mixture of two normal distributions. */
    private record Place(
            BoxState run,
            double runX,
            double runY,
            BoxState last,
            double tumbleVariance,
            double tumbled,
            double rival) {

        /** Distance beyond which no match gains anything: there, neither part reaches half the rival density. */
        double reach() {
            double runReach = reach(Math.max(runX, runY), (1 - tumbled) / Math.sqrt(runX * runY))
                    + Math.abs(run.x().value() - last.x().value());
            return Math.max(runReach, reach(tumbleVariance, tumbled / tumbleVariance));
        }

        private double reach(double variance, double weight) {
            return Math.sqrt(Math.max(0, 2 * variance * Math.log(weight / (Math.PI * rival))));
        }

        double gain(Box box) {
            double run2 = square(box.centreX() - run.x().value()) / runX
                    + square(box.centreY() - run.y().value()) / runY;
            double tumble2 = (square(box.centreX() - last.x().value())
                            + square(box.centreY() - last.y().value()))
                    / tumbleVariance;
            double density = ((1 - tumbled) * Math.exp(-run2 / 2) / Math.sqrt(runX * runY)
                            + tumbled * Math.exp(-tumble2 / 2) / tumbleVariance)
                    / (2 * Math.PI);
            return Math.log(density / rival);
        }

        private static double square(double value) {
            return value * value;
        }
    }

    @Override
    public List<Pair> match(List<Tracklet> tracklets, List<Detection> detections) {
        DetectionsAlongX alongX = new DetectionsAlongX(detections);
        List<Pair> pairs = new ArrayList<>();
        for (int i = 0; i < tracklets.size(); i++) {
            int track = i;
            Tracklet tracklet = tracklets.get(i);
            Place place = placeOf(tracklet);
            alongX.forEachNear(place.last.x().value(), place.reach(), detection -> {
                Detection found = detections.get(detection);
                double gain = place.gain(found.box());
                if (gain > 0) {
                    pairs.add(new Pair(track, detection, Math.max(LEAST_GAIN, gain + ofContrast(tracklet, found))));
                }
            });
        }
        return Matching.best(tracklets.size(), detections.size(), pairs);
    }

    private double ofContrast(Tracklet tracklet, Detection found) {
        Axis known = tracklet.contrast();
        return known == null ? 0 : swimmers.contrast().gain(known, found.contrast());
    }

    private Place placeOf(Tracklet tracklet) {
        MotionModel model = swimmers.motion();
        BoxState state = tracklet.state();
        double measurement = model.position().measurement();
        int frames = tracklet.framesWithoutDetection();
        return new Place(
                state,
                state.x().variance() + measurement,
                state.y().variance() + measurement,
                tracklet.lastDetected(),
                2 * measurement + TUMBLE_SPREAD * model.position().startVelocity() * frames * frames,
                1 - Math.pow(1 - model.tumble(), frames),
                NEW_DENSITY * Math.exp(FORGETTING * frames));
    }
}
