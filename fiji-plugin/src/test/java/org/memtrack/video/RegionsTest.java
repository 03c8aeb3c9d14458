// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.video;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import ij.gui.Line;
import ij.gui.OvalRoi;
import ij.gui.PolygonRoi;
import ij.gui.Roi;
import ij.gui.ShapeRoi;
import ij.io.RoiDecoder;
import java.util.Base64;
import java.util.Map;
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
        assertThat(mask.inside().get(8 * 20 + 15)).isTrue();
        assertThat(mask.inside().get(8 * 20 + 14)).isFalse();
    }

    @Test
    void aRoundSelectionHasNoCorners() {
        image.setRoi(new OvalRoi(0, 0, 10, 10));
        RegionMask mask = Regions.of(image).orElseThrow();
        assertThat(mask.inside().get(5 * 20 + 5)).isTrue();
        assertThat(mask.inside().get(0 * 20 + 0)).isFalse();
    }

    @Test
    void aSelectionIsDescribedSoThatImageJCanRebuildIt() {
        assertThat(Regions.describe(image)).isEmpty();
        image.setRoi(new PolygonRoi(new float[] {2, 12, 7.5f}, new float[] {1, 3, 9}, Roi.POLYGON));
        Map<String, Object> region = Regions.describe(image);
        assertThat(region)
                .containsEntry("kind", "Polygon")
                .containsEntry("x", 2)
                .containsEntry("y", 1)
                .containsEntry("width", 10)
                .containsEntry("height", 8);

        RegionMask mask = Regions.of(image).orElseThrow();
        image.setRoi(RoiDecoder.openFromByteArray(
                Base64.getDecoder().decode(region.get("roi").toString())));
        assertThat(Regions.of(image)).hasValue(mask);
    }

    @Test
    void ofASelectionWithVeryManyPartsOnlyTheBoundsAreTold() {
        ShapeRoi squares = new ShapeRoi(new Roi(0, 0, 1, 1));
        for (int i = 1; i < 4000; i++) {
            squares.or(new ShapeRoi(new Roi(2 * (i % 100), 2 * (i / 100), 1, 1)));
        }
        image.setRoi(squares);
        assertThat(Regions.describe(image))
                .containsEntry("kind", "Composite")
                .containsEntry("width", 199)
                .doesNotContainKey("roi");
    }

    @Test
    void aStraightLineTellsALengthAndIsNoRegion() {
        assertThat(Regions.lineLength(image)).isEmpty();
        image.setRoi(new Line(1, 1, 4, 5));
        assertThat(Regions.lineLength(image)).hasValue(5);
        assertThat(Regions.of(image)).isEmpty();
        assertThat(Regions.describe(image)).isEmpty();
    }

    @Test
    void aCrookedLineOrASelectionOutsideIsRefused() {
        image.setRoi(new PolygonRoi(new float[] {1, 8, 8}, new float[] {1, 8, 1}, Roi.POLYLINE));
        assertThatThrownBy(() -> Regions.of(image))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("no area");
        image.setRoi(new Roi(100, 100, 5, 5));
        assertThatThrownBy(() -> Regions.of(image))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("outside");
    }
}
