// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.List;

/**
 * Tracks that the track filter kept.
 *
 * @param tracks in order of their first frame, numbered from 0
 * @param dropped how many others it dropped; those of the second look, of which most are none, are not counted
 */
public record FilteredTracks(List<Track> tracks, int dropped) {
    public FilteredTracks {
        tracks = List.copyOf(tracks);
    }
}
