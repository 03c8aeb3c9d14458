// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.util.ArrayList;
import java.util.List;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.tracking.Matching.Pair;

/**
 * SORT, frame by frame: predict, match, update, begin and end tracklets.
 *
 * <p>Bewley et al. 2016, "Simple online and realtime tracking". A tracklet gets the points that can be told at once; gaps
 * are filled afterwards, since where a swimmer was in one is told by its way after it, too.
 */
final class Sort {
    private final SortSettings settings;
    private final SwimmerModel swimmers;
    private final Associator associator;
    private final List<Tracklet> tracklets = new ArrayList<>();
    private final List<Tracklet> growing = new ArrayList<>();
    private int framesSeen;

    /**
     * Before the first frame.
     *
     * @param swimmers how those of the film move and look
     */
    Sort(SortSettings settings, SwimmerModel swimmers) {
        this.settings = settings;
        this.swimmers = swimmers;
        this.associator = switch (settings.association()) {
            case OVERLAP -> new OverlapAssociation(settings.iouGate());
            case MOTION -> new MotionAssociation(swimmers);
        };
    }

    /** Takes the next frame, also one without detections. */
    void step(FrameDetections frame) {
        framesSeen++;
        growing.forEach(Tracklet::predict);
        growing.removeIf(tracklet -> !tracklet.state().isBox());
        List<Detection> unmatched = match(frame.detections());
        for (Detection detection : unmatched) {
            Tracklet begun = new Tracklet(detection, swimmers);
            tracklets.add(begun);
            growing.add(begun);
        }
        growing.forEach(tracklet -> report(tracklet, frame.frame()));
        growing.removeIf(tracklet -> tracklet.framesWithoutDetection() > settings.maximumAge());
    }

    /** All tracklets so far, in the order in which they began. */
    List<Tracklet> tracklets() {
        return tracklets;
    }

    private List<Detection> match(List<Detection> detections) {
        boolean[] matched = new boolean[detections.size()];
        DetectionsAlongX alongX = new DetectionsAlongX(detections);
        for (Pair pair : associator.match(growing, detections)) {
            Detection detection = detections.get(pair.detection());
            boolean alone = alongX.isAlone(detection, ContrastModel.APART * swimmers.edge());
            growing.get(pair.track()).update(detection, alone);
            matched[pair.detection()] = true;
        }
        List<Detection> unmatched = new ArrayList<>();
        for (int i = 0; i < matched.length; i++) {
            if (!matched[i]) {
                unmatched.add(detections.get(i));
            }
        }
        return unmatched;
    }

    private void report(Tracklet tracklet, int frame) {
        Detection detection = tracklet.detection();
        switch (settings.interpolation()) {
            case FILL_GAPS -> {
                if (detection != null) {
                    tracklet.add(new TrackPoint(frame, detection.box(), detection));
                }
            }
            case AUTHORS -> {
                // The last of the frames that a track survives without a detection is not reported, in SORT neither.
                boolean recent = detection != null || tracklet.framesWithoutDetection() < settings.maximumAge();
                boolean sure = tracklet.hitStreak() >= settings.minimumHits() || framesSeen <= settings.minimumHits();
                if (recent && sure) {
                    tracklet.add(new TrackPoint(frame, tracklet.state().box(), detection));
                }
            }
        }
    }
}
