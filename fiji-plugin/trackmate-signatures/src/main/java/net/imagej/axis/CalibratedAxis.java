// SPDX-License-Identifier: GPL-3.0-or-later
package net.imagej.axis;

public interface CalibratedAxis extends Axis {
    String unit();

    double averageScale(double from, double to);
}
