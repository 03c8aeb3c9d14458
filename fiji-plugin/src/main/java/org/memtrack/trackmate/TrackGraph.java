// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.Spot;
import java.util.ArrayList;
import java.util.List;
import org.jgrapht.graph.DefaultWeightedEdge;
import org.jgrapht.graph.SimpleWeightedGraph;
import org.memtrack.detection.Detection;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;

/**
 * Tracks as TrackMate's graph of spots.
 *
 * @param graph one edge between consecutive spots of a track; it costs 1 less the intersection over union of their boxes
 * @param interpolated the spots of the graph that stand for no detection, in order of track and frame
 */
record TrackGraph(SimpleWeightedGraph<Spot, DefaultWeightedEdge> graph, List<Spot> interpolated) {

    /** The graph of tracks that were found among a film's spots. */
    static TrackGraph of(List<Track> tracks, SpotFilm film) {
        SimpleWeightedGraph<Spot, DefaultWeightedEdge> graph = new SimpleWeightedGraph<>(DefaultWeightedEdge.class);
        List<Spot> interpolated = new ArrayList<>();
        for (Track track : tracks) {
            List<TrackPoint> points = track.points();
            Spot last = null;
            for (int i = 0; i < points.size(); i++) {
                TrackPoint point = points.get(i);
                Detection detection = point.detection();
                Spot spot;
                if (detection == null) {
                    spot = film.interpolate(point.frame(), point.box());
                    interpolated.add(spot);
                } else {
                    spot = film.spotOf(detection);
                }
                graph.addVertex(spot);
                if (last != null) {
                    double overlap = point.box().iou(points.get(i - 1).box());
                    graph.setEdgeWeight(graph.addEdge(last, spot), 1 - overlap);
                }
                last = spot;
            }
        }
        return new TrackGraph(graph, interpolated);
    }
}
