// SPDX-License-Identifier: GPL-3.0-or-later
package net.imglib2.algorithm;

public interface Benchmark {
    long getProcessingTime();
}
