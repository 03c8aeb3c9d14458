// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.OptionalDouble;

/**
 * What one of our files holds.
 *
 * @param version format and version as the file names itself, for example "TrackMate 8.0.0"
 * @param spots every spot, also those of no track
 * @param tracks every track
 * @param pixelSizeMicrometres empty when the file is in pixels
 * @param frameIntervalSeconds empty when the file is in frames
 * @param image of the film as the file names it
 */
record ImportedTracks(
        String version,
        List<ImportedSpot> spots,
        List<ImportedTrack> tracks,
        OptionalDouble pixelSizeMicrometres,
        OptionalDouble frameIntervalSeconds,
        Optional<Path> image) {

    /** From a format that knows neither calibration nor film, nor spots of no track. */
    static ImportedTracks of(String version, List<ImportedTrack> tracks) {
        List<ImportedSpot> spots =
                tracks.stream().flatMap(track -> track.spots().stream()).toList();
        return new ImportedTracks(
                version, spots, tracks, OptionalDouble.empty(), OptionalDouble.empty(), Optional.empty());
    }
}
