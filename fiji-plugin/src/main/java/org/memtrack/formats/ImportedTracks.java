// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;

/**
 * What a file of tracks holds.
 *
 * @param version format and version as the file names itself, for example "TrackMate 8.0.0"
 * @param spots every spot, also those of no track
 * @param tracks every track
 * @param pixelSizeMicrometres by which coordinates were divided; empty when the file is in pixels or does not say
 * @param frameIntervalSeconds empty when the file does not say
 * @param image of the film as the file names it
 */
public record ImportedTracks(
        String version,
        List<ImportedSpot> spots,
        List<ImportedTrack> tracks,
        OptionalDouble pixelSizeMicrometres,
        OptionalDouble frameIntervalSeconds,
        Optional<Path> image) {
    public ImportedTracks {
        spots = List.copyOf(spots);
        tracks = List.copyOf(tracks);
    }
}
