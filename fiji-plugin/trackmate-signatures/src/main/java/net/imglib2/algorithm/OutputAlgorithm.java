// SPDX-License-Identifier: GPL-3.0-or-later
package net.imglib2.algorithm;

public interface OutputAlgorithm<F> extends Algorithm {
    F getResult();
}
