// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.detection;

/** Motility level of the detector that found a box (paper section "Multi-level Object Detector"). */
public enum Level {
    LOW,
    MEDIUM,
    HIGH,
    /** Not found by a MEMTrack detector, for example a spot of another TrackMate detector. */
    UNSPECIFIED
}
