// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.detection.SpotGlobalDetector;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CancellationException;
import net.imagej.ImgPlus;
import net.imglib2.Interval;
import net.imglib2.type.NativeType;
import net.imglib2.type.numeric.RealType;
import org.memtrack.client.DetectionResult;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.ModelInUse;
import org.memtrack.client.Progress;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.DetectorException;
import org.memtrack.detection.FrameDetections;
import org.memtrack.formats.SpotFeature;
import org.memtrack.server.ServerConnection;

/**
 * Sends the film to the server and turns its detections into spots.
 *
 * <p>The selection's outline is left to TrackMate, which drops spots outside of it; its bounds are told to the server.
 */
final class MemtrackDetector<T extends RealType<T> & NativeType<T>> extends StoppableModule
        implements SpotGlobalDetector<T> {
    /** Where the server is had from. */
    interface Connector {
        ServerConnection acquire(Progress progress);
    }

    private static final double SERVER_STARTED = 0.05;

    private final ImgPlus<T> image;
    private final Map<String, Object> settings;
    private final Interval interval;
    private final Connector connector;

    private SpotCollection spots = new SpotCollection();
    private long processingTime;

    MemtrackDetector(ImgPlus<T> image, Map<String, Object> settings, Interval interval, Connector connector) {
        this.image = image;
        this.settings = settings;
        this.interval = interval;
        this.connector = connector;
    }

    /** TrackMate does not check a detector's settings before it runs it; this does. */
    @Override
    public boolean checkInput() {
        String problem = DetectorSettings.check(settings);
        if (problem == null) {
            try {
                FilmOfImg.of(image, DetectorSettings.channel(settings), interval);
            } catch (DetectorException e) {
                problem = e.getMessage();
            }
        }
        return isFine(problem);
    }

    @Override
    public boolean process() {
        long start = System.nanoTime();
        try {
            detect(FilmOfImg.of(image, DetectorSettings.channel(settings), interval));
            return true;
        } catch (CancellationException e) {
            // What TrackMate expects of a module that was stopped.
            return true;
        } catch (DetectorException | IllegalArgumentException e) {
            return isFine(e.getMessage());
        } finally {
            processingTime = (System.nanoTime() - start) / 1_000_000;
            logger.setStatus("");
        }
    }

    private void detect(FilmOfImg film) {
        DetectionSettings detection = DetectorSettings.fromMap(settings).withRegion(film.region());
        Progress progress = new LoggerProgress(logger, this::isCanceled);
        try (ServerConnection connection = connector.acquire(progress.between(0, SERVER_STARTED))) {
            logger.log("MEMTrack server: %s%n".formatted(connection.origin()));
            note(connection.warnings());
            DetectionResult result = connection.detect(film.film(), detection, progress.between(SERVER_STARTED, 1));
            tell(result);
            spots = spotsOf(result, film);
        }
    }

    private void tell(DetectionResult result) {
        ModelInUse model = result.accepted();
        logger.log("Model %s %s on %s.%n".formatted(model.name(), model.version(), model.engine()));
        note(result.warnings());
        logger.log("%s.%n".formatted(result.summary().describe(model.thresholds())));
        if (result.summary().kept() == 0) {
            logger.log(
                    result.summary().nearMisses() > 0
                            ? "To see them, choose maximum F1 or lower the thresholds.\n"
                            : "Nothing in this film looks like a bacterium to this model: check the channel, and give the"
                                    + " cell length if the film has no pixel size.\n");
        }
    }

    private void note(List<String> warnings) {
        warnings.forEach(warning -> logger.log("Note: %s%n".formatted(warning)));
    }

    private SpotCollection spotsOf(DetectionResult result, FilmOfImg film) {
        SpotCollection collection = new SpotCollection();
        for (FrameDetections frame : result.frames()) {
            for (Detection detection : frame.detections()) {
                Spot spot = spotOf(detection, film);
                SpotDrift.put(spot, frame.driftX() * film.pixelWidth(), frame.driftY() * film.pixelHeight());
                collection.add(spot, film.film().firstFrame() + frame.frame());
            }
        }
        return collection;
    }

    private static Spot spotOf(Detection detection, FilmOfImg film) {
        Box box = detection.box();
        double width = box.width() * film.pixelWidth();
        double height = box.height() * film.pixelHeight();
        Spot spot = Spots.at(
                box.centreX() * film.pixelWidth(),
                box.centreY() * film.pixelHeight(),
                (width + height) / 4,
                detection.score());
        spot.putFeature(SpotFeature.LEVEL.key(), (double) SpotFeature.codeOf(detection.level()));
        spot.putFeature(SpotFeature.SCORE.key(), detection.score());
        if (Double.isFinite(detection.contrast())) {
            spot.putFeature(SpotFeature.CONTRAST.key(), detection.contrast());
        }
        if (Double.isFinite(detection.error())) {
            spot.putFeature(SpotFeature.POSITION_ERROR.key(), detection.error() * film.pixelWidth());
        }
        spot.putFeature(SpotFeature.BOX_WIDTH.key(), width);
        spot.putFeature(SpotFeature.BOX_HEIGHT.key(), height);
        spot.putFeature(SpotFeature.INTERPOLATED.key(), 0.0);
        return spot;
    }

    @Override
    public SpotCollection getResult() {
        return spots;
    }

    @Override
    public long getProcessingTime() {
        return processingTime;
    }
}
