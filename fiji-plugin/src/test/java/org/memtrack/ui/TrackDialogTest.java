// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ij.IJ;
import ij.ImagePlus;
import ij.Prefs;
import ij.io.FileInfo;
import java.io.File;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.TrackOption;

class TrackDialogTest {
    @TempDir
    private Path disk;

    @BeforeEach
    @AfterEach
    void forgetWhatWasRemembered() {
        for (TrackOption option : TrackOption.values()) {
            Prefs.set("memtrack." + option.key(), null);
        }
    }

    @Test
    void aSuggestionLeftAsItIsMakesWayForOneBesideTheNextFilm() throws Exception {
        ImagePlus monday = filmIn("Montag, Jörg");
        ImagePlus tuesday = filmIn("Dienstag");

        Map<TrackOption, String> values = TrackDialog.remembered(monday);
        assertThat(values).containsEntry(TrackOption.OUTPUT, path("Montag, Jörg"));
        TrackDialog.remember(monday, asTheDialogGivesItBack(values));

        assertThat(TrackDialog.remembered(tuesday)).containsEntry(TrackOption.OUTPUT, path("Dienstag"));
    }

    @Test
    void aFolderOfTheUsersOwnIsOfferedForTheNextFilmToo() throws Exception {
        String own = disk.resolve("results").toString();
        ImagePlus monday = filmIn("monday");
        Map<TrackOption, String> values = TrackDialog.remembered(monday);
        values.put(TrackOption.OUTPUT, own);
        TrackDialog.remember(monday, values);

        ImagePlus tuesday = filmIn("tuesday");
        assertThat(TrackDialog.remembered(tuesday)).containsEntry(TrackOption.OUTPUT, own);
        TrackDialog.remember(tuesday, TrackDialog.remembered(tuesday));
        assertThat(TrackDialog.remembered(filmIn("wednesday"))).containsEntry(TrackOption.OUTPUT, own);
    }

    @Test
    void whoGoesBackToTheFolderBesideTheFilmIsOfferedItAgain() throws Exception {
        ImagePlus monday = filmIn("monday");
        Map<TrackOption, String> values = TrackDialog.remembered(monday);
        values.put(TrackOption.OUTPUT, disk.resolve("results").toString());
        TrackDialog.remember(monday, values);
        values.put(TrackOption.OUTPUT, path("monday"));
        TrackDialog.remember(monday, values);

        assertThat(TrackDialog.remembered(filmIn("tuesday"))).containsEntry(TrackOption.OUTPUT, path("tuesday"));
    }

    @Test
    void aFilmThatLiesInNoFolderHasNoSuggestionAndKeepsTheUsersOwn() {
        ImagePlus unsaved = IJ.createImage("unsaved", "8-bit", 8, 8, 9);
        Map<TrackOption, String> values = TrackDialog.remembered(unsaved);
        assertThat(values).containsEntry(TrackOption.OUTPUT, "");

        values.put(TrackOption.OUTPUT, disk.toString());
        TrackDialog.remember(unsaved, values);
        assertThat(TrackDialog.remembered(unsaved)).containsEntry(TrackOption.OUTPUT, disk.toString());
    }

    @Test
    void otherValuesAreRememberedButNotThoseOfTheFilm() throws Exception {
        ImagePlus monday = filmIn("monday");
        Map<TrackOption, String> values = TrackDialog.remembered(monday);
        values.put(TrackOption.PRESET, "water");
        values.put(TrackOption.CELL_LENGTH, "9");
        TrackDialog.remember(monday, values);

        assertThat(TrackDialog.remembered(monday))
                .containsEntry(TrackOption.PRESET, "water")
                .containsEntry(TrackOption.CELL_LENGTH, "");
    }

    @Test
    void whatTheImageSaysIsNoChoiceOfTheUserUntilTheyChangeIt() throws Exception {
        ImagePlus film = filmIn("monday");
        film.getCalibration().setUnit("um");
        film.getCalibration().pixelWidth = 0.2475;
        film.getCalibration().frameInterval = 1 / 30.0;
        Map<TrackOption, String> ofTheImage = TrackDialog.ofTheImage(film);
        Map<TrackOption, String> values = TrackDialog.remembered(film);
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
    void slicesThatAreNoFramesAreNoFilm() {
        ImagePlus stack = IJ.createImage("stack", "8-bit", 8, 8, 9);
        assertThat(TrackDialog.axis(stack, true)).isEqualTo("z");
        assertThatThrownBy(() -> TrackDialog.axis(stack, false))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining("\"stack\" shows a single moment");
    }

    /** ImageJ's field for a folder ends every path with a separator. */
    private static Map<TrackOption, String> asTheDialogGivesItBack(Map<TrackOption, String> values) {
        values.computeIfPresent(TrackOption.OUTPUT, (option, folder) -> folder + File.separator);
        return values;
    }

    private ImagePlus filmIn(String folder) throws Exception {
        ImagePlus film = IJ.createImage("film", "8-bit", 8, 8, 9);
        FileInfo info = new FileInfo();
        info.directory = Files.createDirectories(disk.resolve(folder)) + File.separator;
        info.fileName = "film.tif";
        film.setFileInfo(info);
        return film;
    }

    private String path(String folder) {
        return disk.resolve(folder).resolve("memtrack").toString();
    }
}
