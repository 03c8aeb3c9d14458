// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

/** Type of one grey sample. */
public enum SampleType {
    UINT8(1),
    UINT16(2),
    FLOAT32(4);

    private final int bytes;

    SampleType(int bytes) {
        this.bytes = bytes;
    }

    /** Size of a sample, in bytes. */
    public int bytes() {
        return bytes;
    }
}
