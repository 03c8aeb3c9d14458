// SPDX-License-Identifier: GPL-3.0-or-later
package net.imglib2.algorithm;

public interface MultiThreaded {
    void setNumThreads();

    void setNumThreads(int numThreads);

    int getNumThreads();
}
