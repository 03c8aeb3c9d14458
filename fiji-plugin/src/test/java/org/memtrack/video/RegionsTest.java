// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import ij.gui.Line;
import ij.gui.OvalRoi;
import ij.gui.Roi;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.DetectorException;

class RegionsTest {
    private final ImagePlus image = IJ.createImage("film", "8-bit", 20, 10, 1);

    @Test
    void noSelectionIsNoRegion() {
        assertThat(Regions.of(image)).isEmpty();
    }

    @Test
    void aSelectionBecomesItsPixelsInsideTheImage() {
        image.setRoi(new Roi(15, 8, 10, 10));
        RegionMask mask = Regions.of(image).orElseThrow();
        assertThat(mask.inside().cardinality()).isEqualTo(5 * 2);
        assertThat(mask.contains(15, 8)).isTrue();
        assertThat(mask.contains(14, 8)).isFalse();
        assertThat(mask.contains(20, 9)).isFalse();
    }

    @Test
    void aRoundSelectionHasNoCorners() {
        image.setRoi(new OvalRoi(0, 0, 10, 10));
        RegionMask mask = Regions.of(image).orElseThrow();
        assertThat(mask.contains(5, 5)).isTrue();
        assertThat(mask.contains(0, 0)).isFalse();
    }

    @Test
    void aLineOrASelectionOutsideIsRefused() {
        image.setRoi(new Line(1, 1, 8, 8));
        assertThatThrownBy(() -> Regions.of(image))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("no area");
        image.setRoi(new Roi(100, 100, 5, 5));
        assertThatThrownBy(() -> Regions.of(image))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("outside");
    }
}
