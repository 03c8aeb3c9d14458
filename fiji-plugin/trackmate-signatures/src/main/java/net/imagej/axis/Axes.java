// SPDX-License-Identifier: GPL-3.0-or-later
package net.imagej.axis;

public final class Axes {
    public static final AxisType X = signature();
    public static final AxisType Y = signature();
    public static final AxisType Z = signature();
    public static final AxisType TIME = signature();
    public static final AxisType CHANNEL = signature();

    private Axes() {}

    private static AxisType signature() {
        throw new UnsupportedOperationException();
    }
}
