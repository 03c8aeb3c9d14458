// SPDX-License-Identifier: GPL-3.0-or-later
import fiji.plugin.trackmate.Logger;
import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.TrackMate;
import fiji.plugin.trackmate.detection.DetectorKeys;
import fiji.plugin.trackmate.detection.LogDetectorFactory;
import fiji.plugin.trackmate.tracking.jaqaman.SimpleSparseLAPTrackerFactory;
import ij.IJ;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Set;

/**
 * TrackMate without MEMTrack on a film without calibration: LoG detector, sub-pixel, for each radius; then, for each
 * threshold on the quality, its simple LAP tracker with TrackMate's own default settings.
 *
 * <p>{@code java -cp <TrackMate and what it needs> TrackMatePeer.java FILM.tif OUT.csv RADII SPOTS_A_FRAME MIN_LENGTH}
 * writes the tracks that span at least MIN_LENGTH frames, one row a point. RADII are in pixels; each of SPOTS_A_FRAME
 * stands for the threshold that so many spots a frame reach; both are lists with commas.
 */
public class TrackMatePeer {
    public static void main(String[] arguments) throws IOException {
        int minLength = Integer.parseInt(arguments[4]);
        try (PrintWriter out = new PrintWriter(arguments[1], StandardCharsets.UTF_8)) {
            out.println("radius,threshold,track,frame,x,y");
            for (String radius : arguments[2].split(",")) {
                Settings settings = settings(arguments[0], Double.parseDouble(radius));
                TrackMate detection = new TrackMate(quiet(), settings);
                run(detection, detection.execDetection());
                List<Spot> spots = new ArrayList<>();
                detection.getModel().getSpots().iterable(false).forEach(spots::add);
                spots.sort(Comparator.comparing(TrackMatePeer::quality).reversed());
                for (String perFrame : arguments[3].split(",")) {
                    int kept = Integer.parseInt(perFrame) * settings.imp.getNFrames();
                    if (kept <= spots.size()) {
                        String name = radius + "," + quality(spots.get(kept - 1));
                        write(out, name, track(spots.subList(0, kept), settings), minLength);
                    }
                }
            }
        }
        System.exit(0);
    }

    private static Settings settings(String film, double radius) {
        Settings settings = new Settings(IJ.openImage(film));
        settings.detectorFactory = new LogDetectorFactory<>();
        settings.detectorSettings = settings.detectorFactory.getDefaultSettings();
        settings.detectorSettings.put(DetectorKeys.KEY_RADIUS, radius);
        settings.detectorSettings.put(DetectorKeys.KEY_THRESHOLD, 0.0);
        settings.detectorSettings.put(DetectorKeys.KEY_DO_SUBPIXEL_LOCALIZATION, true);
        settings.trackerFactory = new SimpleSparseLAPTrackerFactory();
        settings.trackerSettings = settings.trackerFactory.getDefaultSettings();
        return settings;
    }

    private static Model track(List<Spot> spots, Settings settings) {
        SpotCollection kept = new SpotCollection();
        spots.forEach(spot -> kept.add(spot, spot.getFeature(Spot.FRAME).intValue()));
        kept.setVisible(true);
        Model model = quiet();
        model.setSpots(kept, false);
        TrackMate tracking = new TrackMate(model, settings);
        run(tracking, tracking.execTracking());
        return model;
    }

    private static Model quiet() {
        Model model = new Model();
        model.setLogger(Logger.VOID_LOGGER);
        return model;
    }

    private static void run(TrackMate trackMate, boolean succeeded) {
        if (!succeeded) {
            throw new IllegalStateException(trackMate.getErrorMessage());
        }
    }

    private static void write(PrintWriter out, String name, Model model, int minLength) {
        for (int id : model.getTrackModel().trackIDs(false)) {
            Set<Spot> track = model.getTrackModel().trackSpots(id);
            int first = track.stream().mapToInt(TrackMatePeer::frame).min().orElseThrow();
            int last = track.stream().mapToInt(TrackMatePeer::frame).max().orElseThrow();
            if (last - first + 1 >= minLength) {
                track.forEach(spot -> out.printf(
                        "%s,%d,%d,%.3f,%.3f%n", name, id, frame(spot), spot.getDoublePosition(0), spot.getDoublePosition(1)));
            }
        }
    }

    private static int frame(Spot spot) {
        return spot.getFeature(Spot.FRAME).intValue();
    }

    private static double quality(Spot spot) {
        return spot.getFeature(Spot.QUALITY);
    }
}
