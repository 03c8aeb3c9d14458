// SPDX-License-Identifier: GPL-3.0-or-later
package net.imagej;

import net.imagej.axis.Axis;
import net.imagej.axis.AxisType;
import net.imglib2.img.Img;

public abstract class ImgPlus<T> implements Img<T> {
    ImgPlus() {}

    public abstract String getName();

    public abstract int dimensionIndex(AxisType type);

    public abstract Axis axis(int dimension);
}
