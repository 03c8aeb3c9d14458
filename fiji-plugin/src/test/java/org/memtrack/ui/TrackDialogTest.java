// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.TrackOption;

class TrackDialogTest {
    @Test
    void whatTheImageSaysIsNoChoiceOfTheUserUntilTheyChangeIt() {
        ImagePlus film = IJ.createImage("film", "8-bit", 8, 8, 9);
        film.getCalibration().setUnit("um");
        film.getCalibration().pixelWidth = 0.2475;
        film.getCalibration().frameInterval = 1 / 30.0;
        Map<TrackOption, String> ofTheImage = TrackDialog.ofTheImage(film);
        Map<TrackOption, String> values = RememberedOptions.of(film);
        values.putAll(ofTheImage);
        assertThat(values)
                .containsEntry(TrackOption.PIXEL_SIZE, "0.2475")
                .containsEntry(TrackOption.FRAME_INTERVAL, "0.0333333");
        assertThat(TrackDialog.keyed(values, ofTheImage))
                .containsEntry("preset", "collagen")
                .doesNotContainKeys("pixel_size", "frame_interval");

        values.put(TrackOption.FRAME_INTERVAL, "0.5");
        assertThat(TrackDialog.keyed(values, ofTheImage))
                .containsEntry("frame_interval", "0.5")
                .doesNotContainKey("pixel_size");
    }

    @Test
    void theUserIsToldWhatThePixelSizeMeans() {
        assertThat(TrackDialog.aboutScale(Map.of(TrackOption.PIXEL_SIZE, "0.25")))
                .contains("2 um long")
                .doesNotContain("pixel size");
        assertThat(TrackDialog.aboutScale(Map.of(TrackOption.PIXEL_SIZE, "")))
                .contains("does not say its pixel size", "2 um long", "used as it is");
    }

    @Test
    void slicesThatAreNoFramesAreNoFilm() {
        ImagePlus stack = IJ.createImage("stack", "8-bit", 8, 8, 9);
        assertThat(TrackDialog.axis(stack, true)).isEqualTo("z");
        assertThatThrownBy(() -> TrackDialog.axis(stack, false))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("\"stack\" shows a single moment");
    }
}
