// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.function.BooleanSupplier;
import java.util.function.DoubleConsumer;
import org.memtrack.detection.FrameDetections;

/** Joins the detections of a film into tracks (paper section "Interpolated Tracker"). */
public final class SortTracker {
    private final SortSettings settings;

    public SortTracker(SortSettings settings) {
        this.settings = settings;
    }

    /** Tracks of a film; as {@link #track(List, DoubleConsumer, BooleanSupplier)}, not to be stopped. */
    public List<Track> track(List<FrameDetections> frames) {
        return track(frames, fraction -> {}, () -> false);
    }

    /**
     * Tracks of a film.
     *
     * @param frames in ascending order of frame; a frame that is left out counts as one without detections
     * @param progress told the share of the work that is done, in [0, 1]
     * @param cancelled asked once a frame
     * @return tracks in order of their first frame, numbered from 0
     * @throws CancellationException when {@code cancelled} said so
     * @throws IllegalArgumentException when the frames are not in ascending order
     */
    public List<Track> track(List<FrameDetections> frames, DoubleConsumer progress, BooleanSupplier cancelled) {
        throw new UnsupportedOperationException("To come with " + settings);
    }
}
