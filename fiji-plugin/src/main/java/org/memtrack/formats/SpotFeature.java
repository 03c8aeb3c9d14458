// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

/**
 * What MEMTrack tells of a spot besides what TrackMate knows, as it stands in TrackMate's models and files.
 *
 * <p>Keys never change: files that are already written hold them.
 */
public enum SpotFeature {
    /** Level of the detector that found the spot: 0 unspecified, 1 low, 2 medium, 3 high. */
    LEVEL("MEMTRACK_LEVEL", "MEMTrack level", "Level", "NONE", true),
    /** Score of the detector in [0, 1], as it was before anybody touched the quality; not set when interpolated. */
    SCORE("MEMTRACK_SCORE", "MEMTrack score", "Score", "QUALITY", false),
    /** Width of the box, in the model's unit of length. */
    BOX_WIDTH("MEMTRACK_BOX_WIDTH", "MEMTrack box width", "Box width", "LENGTH", false),
    /** Height of the box, in the model's unit of length. */
    BOX_HEIGHT("MEMTRACK_BOX_HEIGHT", "MEMTrack box height", "Box height", "LENGTH", false),
    /** 1 when the tracker put the spot where no detection was found, 0 when it was observed. */
    INTERPOLATED("MEMTRACK_INTERPOLATED", "MEMTrack interpolated", "Interpolated", "NONE", true);

    private final String key;
    private final String label;
    private final String shortLabel;
    private final String dimension;
    private final boolean whole;

    SpotFeature(String key, String label, String shortLabel, String dimension, boolean whole) {
        this.key = key;
        this.label = label;
        this.shortLabel = shortLabel;
        this.dimension = dimension;
        this.whole = whole;
    }

    /** Name in models and files. */
    public String key() {
        return key;
    }

    /** Name in menus and tables. */
    public String label() {
        return label;
    }

    /** Name where there is little room. */
    public String shortLabel() {
        return shortLabel;
    }

    /** What is measured, by the name of TrackMate's {@code Dimension}. */
    public String dimension() {
        return dimension;
    }

    /** Whether its values are whole numbers. */
    public boolean whole() {
        return whole;
    }
}
