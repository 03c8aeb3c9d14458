// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;
import fiji.plugin.trackmate.SpotCollection;
import fiji.plugin.trackmate.tracking.SpotTracker;
import ij.ImagePlus;
import java.util.Locale;
import java.util.Map;
import java.util.concurrent.CancellationException;
import org.jgrapht.graph.DefaultWeightedEdge;
import org.jgrapht.graph.SimpleWeightedGraph;
import org.jspecify.annotations.Nullable;
import org.memtrack.tracking.Field;
import org.memtrack.tracking.FilteredTracks;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.SortTracker;

/**
 * Tracks a collection of spots, and adds to it the spots it interpolates.
 *
 * <p>Spots that an earlier run interpolated are taken out; nothing is changed before the tracks are found. The track filter
 * asks no score of another detector's spots, and no edge of the field where there is no image.
 */
final class MemtrackTracker extends StoppableModule implements SpotTracker {
    private final SpotCollection spots;
    private final Map<String, Object> settings;
    private final @Nullable ImagePlus image;

    private SimpleWeightedGraph<Spot, DefaultWeightedEdge> graph = new SimpleWeightedGraph<>(DefaultWeightedEdge.class);

    MemtrackTracker(SpotCollection spots, Map<String, Object> settings, @Nullable ImagePlus image) {
        this.spots = spots;
        this.settings = settings;
        this.image = image;
    }

    @Override
    public boolean checkInput() {
        String problem = TrackerSettings.check(settings);
        if (problem == null && image != null && image.getNSlices() > 1) {
            problem =
                    ("The %s works in one plane, and \"%s\" has %d slices: project them with Image > Stacks > Z Project,"
                                    + " or swap Z and T in Image > Properties.")
                            .formatted(MemtrackTrackerFactory.NAME, image.getTitle(), image.getNSlices());
        }
        if (problem == null && spots.getNSpots(true) == 0) {
            problem = "There is no visible spot to track: lower the detector's thresholds or loosen the spot filters.";
        }
        return isFine(problem);
    }

    @Override
    public boolean process() {
        try {
            track(TrackerSettings.fromMap(settings));
            return true;
        } catch (CancellationException e) {
            // What TrackMate expects of a module that was stopped.
            return true;
        } catch (IllegalArgumentException e) {
            return isFine(e.getMessage() + ".");
        }
    }

    private void track(SortSettings sort) {
        SpotFilm film = SpotFilm.of(spots, image);
        Field field = image == null ? null : new Field(image.getWidth(), image.getHeight());
        FilteredTracks found =
                new SortTracker(sort, field).trackAndFilter(film.frames(), logger::setProgress, this::isCanceled);

        film.removeInterpolated();
        TrackGraph built = TrackGraph.of(found.tracks(), film);
        built.interpolated().forEach(spot -> spots.add(spot, Spots.frame(spot)));
        SpotMeasurements.complete(built.interpolated(), film.observed(), image);
        graph = built.graph();

        logger.log(String.format(
                Locale.ROOT,
                "%d tracks kept, with %d interpolated spots; %d too short or of too low a score were dropped.%n",
                found.tracks().size(),
                built.interpolated().size(),
                found.dropped()));
        if (found.tracks().isEmpty() && found.dropped() > 0) {
            logger.log("To see them, lower the least track length or score.\n");
        }
        if (!film.hasScores()) {
            logger.log(
                    "The least track score was not asked: the spots are not of the MEMTrack detector, and have no score.\n");
        }
    }

    @Override
    public SimpleWeightedGraph<Spot, DefaultWeightedEdge> getResult() {
        return graph;
    }

    /** One thread does: SORT goes from frame to frame. */
    @Override
    public void setNumThreads() {}

    @Override
    public void setNumThreads(int threads) {}

    @Override
    public int getNumThreads() {
        return 1;
    }
}
