// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import org.memtrack.detection.Level;

/** Features of a TrackMate spot that are our own. */
public enum SpotFeature {
    /** Level of the detector that found it: 0 unspecified, 1 low, 2 medium, 3 high, as in the contract. */
    LEVEL("MEMTRACK_LEVEL", "MEMTrack level", "Level", "NONE", true),
    /** 1 when no detection stands behind the spot, 0 otherwise. */
    INTERPOLATED("MEMTRACK_INTERPOLATED", "Interpolated", "Interpol.", "NONE", true),
    /** Width of the box, calibrated. */
    BOX_WIDTH("MEMTRACK_BOX_WIDTH", "Box width", "Box width", "LENGTH", false),
    /** Height of the box, calibrated. */
    BOX_HEIGHT("MEMTRACK_BOX_HEIGHT", "Box height", "Box height", "LENGTH", false),
    /** Score of the detection; an interpolated spot has none. */
    SCORE("MEMTRACK_SCORE", "Detection score", "Score", "QUALITY", false),
    /** How much brighter (above 0) or darker than the background it is, in [-1, 1]; missing when not known. */
    CONTRAST("MEMTRACK_CONTRAST", "Contrast to background", "Contrast", "NONE", false),
    /** How far off the detection's centre is to be expected along x or y, calibrated; missing when not known. */
    POSITION_ERROR("MEMTRACK_POSITION_ERROR", "Position error", "Pos. error", "LENGTH", false),
    /** Class of motility of the track: 0 none, 1 low, 2 medium, 3 high; missing when it is not known. */
    MOTILITY("MEMTRACK_MOTILITY", "Motility class", "Motility", "NONE", true),
    /** How far the scene stands right of its place in the first frame, calibrated; missing when it is not known to move. */
    DRIFT_X("MEMTRACK_DRIFT_X", "Stage drift X", "Drift X", "LENGTH", false),
    /** How far the scene stands below its place in the first frame, likewise. */
    DRIFT_Y("MEMTRACK_DRIFT_Y", "Stage drift Y", "Drift Y", "LENGTH", false);

    private final String key;
    private final String fullName;
    private final String shortName;
    private final String dimension;
    private final boolean integer;

    SpotFeature(String key, String fullName, String shortName, String dimension, boolean integer) {
        this.key = key;
        this.fullName = fullName;
        this.shortName = shortName;
        this.dimension = dimension;
        this.integer = integer;
    }

    public String key() {
        return key;
    }

    public String fullName() {
        return fullName;
    }

    public String shortName() {
        return shortName;
    }

    /** Name of TrackMate's Dimension. */
    public String dimension() {
        return dimension;
    }

    public boolean isInteger() {
        return integer;
    }

    /** Whether it tells of the drift of the stage. */
    boolean isDrift() {
        return this == DRIFT_X || this == DRIFT_Y;
    }

    /** The value of {@link #LEVEL} for a level. */
    public static int codeOf(Level level) {
        return switch (level) {
            case UNSPECIFIED -> 0;
            case LOW -> 1;
            case MEDIUM -> 2;
            case HIGH -> 3;
        };
    }

    /** The level for a value of {@link #LEVEL}; unspecified for a value that stands for none. */
    public static Level levelOf(double code) {
        for (Level level : Level.values()) {
            if (codeOf(level) == code) {
                return level;
            }
        }
        return Level.UNSPECIFIED;
    }
}
