// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.BufferedWriter;
import java.io.IOException;
import java.io.OutputStream;
import java.io.OutputStreamWriter;
import java.io.Writer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.List;
import java.util.OptionalDouble;
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
        AtomicFiles.write(target, out -> write(tracked, out));
    }

    private static void write(TrackedFilm tracked, OutputStream out) throws IOException {
        Writer writer = new BufferedWriter(new OutputStreamWriter(out, StandardCharsets.UTF_8));
        writer.write(HEADER + "\n");
        for (int i = 0; i < tracked.tracks().size(); i++) {
            writer.write(String.join(
                            ",",
                            cells(tracked.tracks().get(i), tracked.motility().get(i))) + "\n");
        }
        writer.flush();
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
                TrackCsv.decimal(motility.meanSpeedPixelsPerFrame()),
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
