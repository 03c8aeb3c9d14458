// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.detection.StageDrift;

class SceneViewTest {
    @Test
    void aDetectionKeepsEverythingButItsPlaceAndComesBackAsItWas() {
        Detection found = new Detection(Box.around(50, 60, 30, 28), 0.75, Level.MEDIUM, -0.25, 0.3);
        FrameDetections frame = new FrameDetections(4, List.of(found), 3, -2);
        SceneView view = new SceneView(new StageDrift(List.of(frame)));

        Detection there = view.inScene(frame).detections().get(0);

        assertThat(there).isEqualTo(new Detection(Box.around(47, 62, 30, 28), 0.75, Level.MEDIUM, -0.25, 0.3));
        assertThat(view.inFilm(List.of(new TrackPoint(4, there.box(), there))))
                .containsExactly(new TrackPoint(4, found.box(), found));
    }
}
