// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.memtrack.motility.TrackMotility;
import org.memtrack.tracking.Track;

/** The features of spots, links and tracks that our TrackMate files declare and carry. */
final class TrackMateFeatures {
    static final String MOTILITY = "MEMTRACK_TRACK_MOTILITY";
    private static final String DIFFUSIVITY = "MEMTRACK_PEAK_DIFFUSIVITY";
    private static final String SPEED = "MEMTRACK_MEAN_SPEED";
    private static final String LAG_SPEED = "MEMTRACK_LAG_SPEED";

    private TrackMateFeatures() {}

    static void declare(IndentedXml xml, TrackedFilm tracked) throws IOException {
        xml.start("FeatureDeclarations");
        xml.start("SpotFeatures");
        declare(xml, "QUALITY", "Quality", "Quality", "QUALITY", false);
        declare(xml, "POSITION_X", "X", "X", "POSITION", false);
        declare(xml, "POSITION_Y", "Y", "Y", "POSITION", false);
        declare(xml, "POSITION_Z", "Z", "Z", "POSITION", false);
        declare(xml, "POSITION_T", "T", "T", "TIME", false);
        declare(xml, "FRAME", "Frame", "Frame", "NONE", true);
        declare(xml, "RADIUS", "Radius", "R", "LENGTH", false);
        declare(xml, "VISIBILITY", "Visibility", "Visibility", "NONE", true);
        for (SpotFeature feature : SpotFeature.values()) {
            if (feature.isDrift() && tracked.drift().isNone()) {
                continue;
            }
            declare(
                    xml,
                    feature.key(),
                    feature.fullName(),
                    feature.shortName(),
                    feature.dimension(),
                    feature.isInteger());
        }
        xml.end();
        xml.start("EdgeFeatures");
        declare(xml, "SPOT_SOURCE_ID", "Source spot ID", "Source ID", "NONE", true);
        declare(xml, "SPOT_TARGET_ID", "Target spot ID", "Target ID", "NONE", true);
        declare(xml, "LINK_COST", "Edge cost", "Cost", "COST", false);
        xml.end();
        xml.start("TrackFeatures");
        declare(xml, "TRACK_INDEX", "Track index", "Index", "NONE", true);
        declare(xml, "TRACK_ID", "Track ID", "ID", "NONE", true);
        declare(xml, "NUMBER_SPOTS", "Number of spots in track", "N spots", "NONE", true);
        declare(xml, "TRACK_DURATION", "Track duration", "Duration", "TIME", false);
        declare(xml, "TRACK_START", "Track start", "Track start", "TIME", false);
        declare(xml, "TRACK_STOP", "Track stop", "Track stop", "TIME", false);
        declare(xml, MOTILITY, "Motility class (0 none, 1 low, 2 medium, 3 high)", "Motility", "NONE", true);
        declare(xml, DIFFUSIVITY, "Peak diffusivity (um^2/s)", "Peak D", "NONE", false);
        declare(xml, SPEED, "Mean speed frame to frame", "Mean speed", "VELOCITY", false);
        declare(xml, LAG_SPEED, "Mean speed over " + tracked.speedLag(), "Lag speed", "VELOCITY", false);
        xml.end();
        xml.end();
    }

    private static void declare(
            IndentedXml xml, String key, String name, String shortName, String dimension, boolean integer)
            throws IOException {
        xml.empty(
                "Feature",
                "feature",
                key,
                "name",
                name,
                "shortname",
                shortName,
                "dimension",
                dimension,
                "isint",
                Boolean.toString(integer));
    }

    /** Attributes of a track, names and values in turn. */
    static String[] ofTrack(int index, TrackedFilm tracked, double intervalSeconds) {
        Track track = tracked.tracks().get(index);
        TrackMotility motility = tracked.motility().get(index);
        double unit = tracked.film().pixelSizeMicrometres().orElse(1) / intervalSeconds;
        List<String> attributes = new ArrayList<>(Arrays.asList(
                "name",
                "Track_" + track.id(),
                "TRACK_ID",
                Integer.toString(track.id()),
                "TRACK_INDEX",
                Integer.toString(index),
                "NUMBER_SPOTS",
                Integer.toString(track.points().size()),
                "TRACK_DURATION",
                Double.toString((track.length() - 1) * intervalSeconds),
                "TRACK_START",
                Double.toString(track.firstFrame() * intervalSeconds),
                "TRACK_STOP",
                Double.toString(track.lastFrame() * intervalSeconds)));
        motility.meanSpeedPixelsPerFrame()
                .ifPresent(speed -> attributes.addAll(List.of(SPEED, Double.toString(speed * unit))));
        motility.lagSpeedPixelsPerFrame()
                .ifPresent(speed -> attributes.addAll(List.of(LAG_SPEED, Double.toString(speed * unit))));
        motility.peakDiffusivity().ifPresent(value -> attributes.addAll(List.of(DIFFUSIVITY, Double.toString(value))));
        motility.motilityClass()
                .ifPresent(value -> attributes.addAll(List.of(MOTILITY, Integer.toString(value.ordinal()))));
        return attributes.toArray(String[]::new);
    }
}
