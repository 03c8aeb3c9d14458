// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.io.OutputStream;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.motility.TrackMotility;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmInfo;

/**
 * Writes one TrackMate file.
 *
 * <p>Positions are calibrated: pixels times pixel size, the centre of pixel (0, 0) at 0. The cost of a link is one minus
 * the intersection over union of its two boxes.
 */
final class TrackMateXmlWriter {
    /** Of the format; TrackMate 7 and 8 read it. */
    private static final String VERSION = "7.14.0";

    private final TrackedFilm tracked;
    private final FilmInfo film;
    private final double pixelSize;
    private final double interval;
    private final boolean drifts;
    private final Map<Integer, List<Spot>> spotsOfFrame = new TreeMap<>();
    private final List<List<Spot>> spotsOfTrack = new ArrayList<>();
    private int spotCount;

    /** A point with its number in the file and the motility of its track. */
    private record Spot(int id, TrackPoint point, TrackMotility motility) {}

    TrackMateXmlWriter(TrackedFilm tracked) {
        this.tracked = tracked;
        this.film = tracked.film();
        this.pixelSize = film.pixelSizeMicrometres().orElse(1);
        this.interval = film.frameIntervalSeconds().orElse(1);
        this.drifts = !tracked.drift().isNone();
        for (int i = 0; i < tracked.tracks().size(); i++) {
            List<Spot> spots = new ArrayList<>();
            for (TrackPoint point : tracked.tracks().get(i).points()) {
                spots.add(number(point, tracked.motility().get(i)));
            }
            spotsOfTrack.add(spots);
        }
    }

    private Spot number(TrackPoint point, TrackMotility motility) {
        Spot spot = new Spot(spotCount++, point, motility);
        spotsOfFrame.computeIfAbsent(point.frame(), frame -> new ArrayList<>()).add(spot);
        return spot;
    }

    void write(OutputStream out) throws IOException {
        IndentedXml xml = new IndentedXml(out);
        xml.start("TrackMate", "version", VERSION);
        xml.text("Log", "Written by MEMTrack: %d tracks.".formatted(spotsOfTrack.size()));
        xml.start(
                "Model",
                "spatialunits",
                film.pixelSizeMicrometres().isPresent() ? "micron" : "pixel",
                "timeunits",
                film.frameIntervalSeconds().isPresent() ? "sec" : "frame");
        TrackMateFeatures.declare(xml, tracked);
        writeSpots(xml);
        writeTracks(xml);
        xml.end();
        if (film.file().isPresent()) {
            TrackMateXmlSettings.write(xml, film, film.file().get());
        }
        xml.empty("GUIState", "state", "ConfigureViews");
        // Empty means the user's own; without it TrackMate tells of errors in the file.
        xml.empty("DisplaySettings");
        xml.end();
        xml.finish();
    }

    private void writeSpots(IndentedXml xml) throws IOException {
        xml.start("AllSpots", "nspots", Integer.toString(spotCount));
        for (Map.Entry<Integer, List<Spot>> frame : spotsOfFrame.entrySet()) {
            xml.start("SpotsInFrame", "frame", Integer.toString(frame.getKey()));
            for (Spot spot : frame.getValue()) {
                xml.empty("Spot", attributesOf(spot));
            }
            xml.end();
        }
        xml.end();
    }

    private String[] attributesOf(Spot spot) {
        TrackPoint point = spot.point();
        Box box = point.box();
        Detection detection = point.detection();
        List<String> attributes = new ArrayList<>(Arrays.asList(
                "ID",
                Integer.toString(spot.id()),
                "name",
                "ID" + spot.id(),
                "QUALITY",
                Double.toString(detection == null ? 0 : detection.score()),
                "POSITION_X",
                Double.toString(box.centreX() * pixelSize),
                "POSITION_Y",
                Double.toString(box.centreY() * pixelSize),
                "POSITION_Z",
                "0.0",
                "POSITION_T",
                Double.toString(point.frame() * interval),
                "FRAME",
                Integer.toString(point.frame()),
                "RADIUS",
                Double.toString((box.width() + box.height()) / 4 * pixelSize),
                "VISIBILITY",
                "1",
                SpotFeature.INTERPOLATED.key(),
                point.interpolated() ? "1" : "0",
                SpotFeature.BOX_WIDTH.key(),
                Double.toString(box.width() * pixelSize),
                SpotFeature.BOX_HEIGHT.key(),
                Double.toString(box.height() * pixelSize)));
        if (drifts) {
            attributes.addAll(List.of(
                    SpotFeature.DRIFT_X.key(),
                    Double.toString(tracked.drift().x(point.frame()) * pixelSize),
                    SpotFeature.DRIFT_Y.key(),
                    Double.toString(tracked.drift().y(point.frame()) * pixelSize)));
        }
        if (detection != null) {
            attributes.addAll(List.of(
                    SpotFeature.LEVEL.key(), Integer.toString(SpotFeature.codeOf(detection.level())),
                    SpotFeature.SCORE.key(), Double.toString(detection.score())));
            if (Double.isFinite(detection.contrast())) {
                attributes.addAll(List.of(SpotFeature.CONTRAST.key(), Double.toString(detection.contrast())));
            }
            if (Double.isFinite(detection.error())) {
                attributes.addAll(
                        List.of(SpotFeature.POSITION_ERROR.key(), Double.toString(detection.error() * pixelSize)));
            }
        }
        spot.motility()
                .motilityClass()
                .ifPresent(motilityClass -> attributes.addAll(
                        List.of(SpotFeature.MOTILITY.key(), Integer.toString(motilityClass.ordinal()))));
        return attributes.toArray(String[]::new);
    }

    private void writeTracks(IndentedXml xml) throws IOException {
        xml.start("AllTracks");
        for (int i = 0; i < spotsOfTrack.size(); i++) {
            if (spotsOfTrack.get(i).size() > 1) {
                writeTrack(xml, i);
            }
        }
        xml.end();
        xml.start("FilteredTracks");
        for (int i = 0; i < spotsOfTrack.size(); i++) {
            if (spotsOfTrack.get(i).size() > 1) {
                xml.empty(
                        "TrackID",
                        "TRACK_ID",
                        Integer.toString(tracked.tracks().get(i).id()));
            }
        }
        xml.end();
    }

    private void writeTrack(IndentedXml xml, int index) throws IOException {
        List<Spot> spots = spotsOfTrack.get(index);
        xml.start("Track", TrackMateFeatures.ofTrack(index, tracked, interval));
        for (int i = 1; i < spots.size(); i++) {
            Spot source = spots.get(i - 1);
            Spot target = spots.get(i);
            xml.empty(
                    "Edge",
                    "SPOT_SOURCE_ID",
                    Integer.toString(source.id()),
                    "SPOT_TARGET_ID",
                    Integer.toString(target.id()),
                    "LINK_COST",
                    Double.toString(1 - source.point().box().iou(target.point().box())));
        }
        xml.end();
    }
}
