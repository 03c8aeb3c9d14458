// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import org.memtrack.detection.Box;
import org.memtrack.tracking.Axis.Noise;

/**
 * A box as the Kalman filter of SORT knows it (Bewley et al. 2016, "Simple online and realtime tracking", section 3.2).
 *
 * @param x of the centre, pixels
 * @param y of the centre, pixels
 * @param area pixels^2
 * @param aspect width over height
 */
record BoxState(Axis x, Axis y, Axis area, Axis aspect) {
    /** Least edge, pixels: a spot detector's box may have no size, and an aspect needs one. */
    private static final double LEAST_EDGE = 0.01;

    /** Surprise beyond which a swimmer has tumbled: a run exceeds it in one of 90 detections. */
    private static final double RUN_LIMIT = 9;

    static BoxState start(Box box, MotionModel model) {
        return new BoxState(
                Axis.start(box.centreX(), model.position()),
                Axis.start(box.centreY(), model.position()),
                Axis.start(areaOf(box), model.area()),
                Axis.start(aspectOf(box), model.aspect()));
    }

    /** One frame later; an area that would vanish stops shrinking. */
    BoxState predict(MotionModel model) {
        Axis steadyArea = area.value() + area.velocity() <= 0 ? area.withoutVelocity() : area;
        Noise noise = model.position();
        double speedSquared = x.velocity() * x.velocity() + y.velocity() * y.velocity();
        double velocityStep = noise.velocityStep() + model.turning() * speedSquared;
        return new BoxState(
                x.predict(model.persistence(), noise.step(), velocityStep),
                y.predict(model.persistence(), noise.step(), velocityStep),
                steadyArea.predict(model.area()),
                aspect.predict(model.aspect()));
    }

    /** Corrected by a detected box. Where tumbles are known, one too far off for a run starts the position anew. */
    BoxState update(Box box, MotionModel model) {
        boolean tumbled = model.tumble() > 0 && surprise(box, model) > RUN_LIMIT;
        return new BoxState(
                tumbled ? Axis.start(box.centreX(), model.position()) : x.update(box.centreX(), model.position()),
                tumbled ? Axis.start(box.centreY(), model.position()) : y.update(box.centreY(), model.position()),
                area.update(areaOf(box), model.area()),
                aspect.update(aspectOf(box), model.aspect()));
    }

    /** Squared distance of a box's centre from the predicted one, in units of its variance. */
    private double surprise(Box box, MotionModel model) {
        double dx = box.centreX() - x.value();
        double dy = box.centreY() - y.value();
        double measurement = model.position().measurement();
        return dx * dx / (x.variance() + measurement) + dy * dy / (y.variance() + measurement);
    }

    /** Whether area and aspect still make a box; a filter led astray by wild sizes may lose it. */
    boolean isBox() {
        return area.value() > 0 && aspect.value() > 0 && Double.isFinite(x.value() + y.value() + area.value());
    }

    Box box() {
        double width = Math.sqrt(area.value() * aspect.value());
        return Box.around(x.value(), y.value(), width, area.value() / width);
    }

    private static double areaOf(Box box) {
        return Math.max(box.width(), LEAST_EDGE) * Math.max(box.height(), LEAST_EDGE);
    }

    private static double aspectOf(Box box) {
        return Math.max(box.width(), LEAST_EDGE) / Math.max(box.height(), LEAST_EDGE);
    }
}
