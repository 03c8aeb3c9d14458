// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.TrackModel;
import ij.ImagePlus;
import ij.measure.Calibration;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.DetectorException;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.SpotFeature;
import org.memtrack.formats.TrackCsv;
import org.memtrack.formats.TrackedFilm;
import org.memtrack.tracking.GapFilling;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;
import org.memtrack.video.ImageFilm;
import org.memtrack.video.Units;

/**
 * The visible tracks of a TrackMate model as ours, whichever detector, tracker or hand made them.
 *
 * @param tracked gaps of a track are filled with interpolated points
 * @param film the film, in the channel that was detected in
 * @param names of the tracks, as TrackMate shows them, in the same order
 * @param measured those of the boxes that MEMTrack gave; the size of the others is a guess
 * @param notes what the user should know, one sentence each
 */
record ModelTracks(TrackedFilm tracked, ImageFilm film, List<String> names, Set<Box> measured, List<String> notes) {

    /**
     * Takes the tracks.
     *
     * @throws DetectorException when there is no film or no visible track
     */
    static ModelTracks of(TrackMate trackmate) {
        Settings settings = trackmate.getSettings();
        ImagePlus image = settings.imp;
        if (image == null) {
            throw new DetectorException("These tracks have no film: open it, then load the TrackMate file again.");
        }
        FilmOptions options = options(trackmate);
        ImageFilm film = new ImageFilm(image, options);
        TrackModel model = trackmate.getModel().getTrackModel();
        List<Track> tracks = new ArrayList<>();
        List<String> names = new ArrayList<>();
        Set<Box> measured = new HashSet<>();
        List<String> branching = new ArrayList<>();
        for (Integer id : new TreeSet<>(model.trackIDs(true))) {
            List<Spot> spots = model.trackSpots(id).stream()
                    .sorted(Comparator.comparingInt(Spots::frame))
                    .toList();
            if (spots.stream().mapToInt(Spots::frame).distinct().count() < spots.size()) {
                branching.add(model.name(id));
            } else {
                tracks.add(track(tracks.size(), spots, settings));
                names.add(model.name(id));
                spots.stream()
                        .filter(Spots::hasBox)
                        .forEach(spot -> measured.add(Spots.box(spot, settings.dx, settings.dy)));
            }
        }
        if (tracks.isEmpty()) {
            throw new DetectorException(
                    branching.isEmpty()
                            ? "There is no visible track: track first, or loosen the track filters."
                            : "Every visible track splits or merges: cut them where they do, in TrackScheme.");
        }
        List<String> notes = calibrationNotes(film.info(), options);
        if (!branching.isEmpty()) {
            notes.add("Left out, since they split or merge: %s.".formatted(String.join(", ", branching)));
        }
        List<FrameDetections> drift = SpotDrift.of(trackmate.getModel().getSpots(), settings.dx, settings.dy);
        return new ModelTracks(TrackedFilm.of(film.info(), tracks, drift), film, names, measured, notes);
    }

    /**
     * What the user should know of the units. The film's own warnings are meant for the menu command: they name its options,
     * which an action does not have, and its files.
     *
     * @param told what TrackMate tells of the film
     */
    static List<String> calibrationNotes(FilmInfo info, FilmOptions told) {
        List<String> notes = new ArrayList<>();
        String remedy = "in Image > Properties and start TrackMate again.";
        List<String> untold =
                Units.untold(info.pixelSizeMicrometres(), "pixel size", info.frameIntervalSeconds(), "frame interval");
        if (!untold.isEmpty()) {
            notes.add("The film has no %s: speeds are in pixels a frame; set what is missing %s"
                    .formatted(String.join(" and no ", untold), remedy));
        }
        if (told.frameIntervalSeconds().isEmpty()) {
            info.frameIntervalSeconds()
                    .ifPresent(interval -> notes.add(String.format(
                            Locale.ROOT,
                            "The frame interval, %.4g s, is taken from the film's playback rate; if it was recorded at another rate, set that %s",
                            interval,
                            remedy)));
        }
        return notes;
    }

    /** Writes them as a table, without the sizes that are a guess. */
    void write(Path table) throws IOException {
        TrackCsv.write(table, tracked, measured::contains);
    }

    /** As the tracks were made: a film that was opened from a TrackMate file may have lost its calibration and axes. */
    private static FilmOptions options(TrackMate trackmate) {
        Settings settings = trackmate.getSettings();
        Calibration calibration = new Calibration();
        calibration.pixelWidth = settings.dx;
        calibration.pixelHeight = settings.dy;
        calibration.setUnit(trackmate.getModel().getSpaceUnits());
        // TrackMate takes 1 s for the interval of a film that does not tell it.
        boolean told = settings.dt != 1 || settings.imp.getCalibration().frameInterval > 0;
        calibration.frameInterval = told ? settings.dt : 0;
        calibration.setTimeUnit(trackmate.getModel().getTimeUnits());
        Map<String, Object> detector = settings.detectorSettings;
        Object channel = detector == null ? null : detector.get(DetectorSettings.CHANNEL);
        return new FilmOptions(
                ImageFilm.framesLieOnZ(settings.imp) ? FrameAxis.Z : FrameAxis.T,
                channel instanceof Integer number && number <= settings.imp.getNChannels() ? Math.max(1, number) : 1,
                1,
                0,
                Units.pixelSizeMicrometres(calibration),
                Units.frameIntervalSeconds(calibration));
    }

    private static Track track(int id, List<Spot> spots, Settings settings) {
        List<TrackPoint> points = spots.stream()
                .map(spot -> {
                    Box box = Spots.box(spot, settings.dx, settings.dy);
                    Detection detection = Spots.interpolated(spot)
                            ? null
                            : new Detection(
                                    box,
                                    Spots.value(spot, Spot.QUALITY, 0),
                                    SpotFeature.levelOf(Spots.value(spot, SpotFeature.LEVEL.key(), 0)));
                    return new TrackPoint(Spots.frame(spot), box, detection);
                })
                .toList();
        boolean whole = spots.size() == Spots.frame(spots.get(spots.size() - 1)) - Spots.frame(spots.get(0)) + 1;
        return new Track(id, whole ? points : GapFilling.fill(points));
    }

    /** Information about the film. */
    FilmInfo info() {
        return tracked.film();
    }
}
