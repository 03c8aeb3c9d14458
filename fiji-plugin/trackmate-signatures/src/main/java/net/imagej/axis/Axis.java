// SPDX-License-Identifier: GPL-3.0-or-later
package net.imagej.axis;

public interface Axis {}
