// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.OptionalDouble;
import java.util.stream.IntStream;
import org.memtrack.motility.TrackMotility;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;

/** How each track moves, as a table: one header row, one row a track; cells as in {@link TrackCsv}. */
public final class MotilityCsv {
    private static final String HEADER = "track,first_frame,last_frame,detections,interpolated,speed_px_per_frame,"
            + "speed_um_s,lag_frames,lag_speed_px_per_frame,lag_speed_um_s,peak_diffusivity_um2_s,motility";

    private MotilityCsv() {}

    /** Writes the motility of the tracks of a film, all or nothing. */
    public static void write(Path target, TrackedFilm tracked) throws IOException {
        CsvFile.write(
                target,
                HEADER,
                IntStream.range(0, tracked.tracks().size())
                        .mapToObj(i -> cells(
                                tracked.tracks().get(i), tracked.motility().get(i))));
    }

    private static List<String> cells(Track track, TrackMotility motility) {
        long interpolated =
                track.points().stream().filter(TrackPoint::interpolated).count();
        return List.of(
                Integer.toString(track.id()),
                Integer.toString(track.firstFrame()),
                Integer.toString(track.lastFrame()),
                Long.toString(track.points().size() - interpolated),
                Long.toString(interpolated),
                cell(motility.meanSpeedPixelsPerFrame()),
                cell(motility.meanSpeed()),
                Integer.toString(motility.lagFrames()),
                cell(motility.lagSpeedPixelsPerFrame()),
                cell(motility.lagSpeed()),
                cell(motility.peakDiffusivity()),
                motility.motilityClass().map(TrackCsv::word).orElse(""));
    }

    private static String cell(OptionalDouble value) {
        return TrackCsv.times(1, value);
    }
}
