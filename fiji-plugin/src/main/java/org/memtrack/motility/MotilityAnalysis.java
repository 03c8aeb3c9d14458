// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.motility;

import java.util.List;
import org.memtrack.detection.FrameDetections;
import org.memtrack.tracking.Track;
import org.memtrack.video.FilmInfo;

/** Motility of the tracks of a film (paper section "Motility"). */
public final class MotilityAnalysis {
    private MotilityAnalysis() {}

    /**
     * Motility of each track, in the order of the tracks.
     *
     * @param film whose calibration is used
     * @param tracks boxes in the coordinates of the raw film
     * @param frames whose drift is taken away; a frame left out has the drift of the one before it
     */
    public static List<TrackMotility> analyse(FilmInfo film, List<Track> tracks, List<FrameDetections> frames) {
        throw new UnsupportedOperationException("To come");
    }
}
