// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.BufferedWriter;
import java.io.IOException;
import java.io.OutputStream;
import java.io.OutputStreamWriter;
import java.io.Writer;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import org.memtrack.motility.MotilityClass;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;

/** Writes MTrackJ data files of version 1.5.1. */
final class MdfWriter {
    static final String VERSION = "1.5.1";

    /** Added to the time of an interpolated point, frames; MTrackJ rounds it away. */
    static final double INTERPOLATED = 0.25;

    /** Colours that people with any colour vision can tell apart (Okabe and Ito): none to high, then unknown. */
    private static final List<String> COLOURS = List.of("999999", "56B4E9", "E69F00", "D55E00", "009E73");

    private MdfWriter() {}

    static void write(TrackedFilm tracked, OutputStream out) throws IOException {
        Map<Integer, List<Track>> clusters = new TreeMap<>();
        for (int i = 0; i < tracked.tracks().size(); i++) {
            int cluster = tracked.motility()
                    .get(i)
                    .motilityClass()
                    .map(MotilityClass::ordinal)
                    .orElse(COLOURS.size() - 1);
            clusters.computeIfAbsent(cluster, none -> new ArrayList<>())
                    .add(tracked.tracks().get(i));
        }
        Writer writer = new BufferedWriter(new OutputStreamWriter(out, StandardCharsets.US_ASCII));
        line(writer, "MTrackJ %s Data File", VERSION);
        line(writer, "Assembly 1 FF0000");
        for (Map.Entry<Integer, List<Track>> cluster : clusters.entrySet()) {
            String colour = COLOURS.get(cluster.getKey());
            line(writer, "Cluster %d %s", cluster.getKey() + 1, colour);
            for (Track track : cluster.getValue()) {
                line(writer, "Track %d %s true", track.id() + 1, colour);
                writePoints(writer, track);
            }
        }
        line(writer, "End of MTrackJ Data File");
        writer.flush();
    }

    private static void writePoints(Writer writer, Track track) throws IOException {
        int number = 0;
        for (TrackPoint point : track.points()) {
            double time = point.frame() + 1 + (point.interpolated() ? INTERPOLATED : 0);
            String x = TrackCsv.decimal(point.box().centreX());
            String y = TrackCsv.decimal(point.box().centreY());
            writer.write("Point " + ++number + " " + x + " " + y + " 1.0 " + time + " 1.0\r\n");
        }
    }

    private static void line(Writer writer, String format, Object... values) throws IOException {
        writer.write(String.format(Locale.ROOT, format, values));
        writer.write("\r\n");
    }
}
