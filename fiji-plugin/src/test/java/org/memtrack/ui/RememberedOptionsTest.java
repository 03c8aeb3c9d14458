// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import static org.assertj.core.api.Assertions.assertThat;

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
import org.memtrack.macro.TrackOption;

class RememberedOptionsTest {
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

        Map<TrackOption, String> values = RememberedOptions.of(monday);
        assertThat(values).containsEntry(TrackOption.OUTPUT, path("Montag, Jörg"));
        RememberedOptions.keep(monday, asTheDialogGivesItBack(values));

        assertThat(RememberedOptions.of(tuesday)).containsEntry(TrackOption.OUTPUT, path("Dienstag"));
    }

    @Test
    void aFolderOfTheUsersOwnIsOfferedForTheNextFilmToo() throws Exception {
        String own = disk.resolve("results").toString();
        ImagePlus monday = filmIn("monday");
        Map<TrackOption, String> values = RememberedOptions.of(monday);
        values.put(TrackOption.OUTPUT, own);
        RememberedOptions.keep(monday, values);

        ImagePlus tuesday = filmIn("tuesday");
        assertThat(RememberedOptions.of(tuesday)).containsEntry(TrackOption.OUTPUT, own);
        RememberedOptions.keep(tuesday, RememberedOptions.of(tuesday));
        assertThat(RememberedOptions.of(filmIn("wednesday"))).containsEntry(TrackOption.OUTPUT, own);
    }

    @Test
    void whoGoesBackToTheFolderBesideTheFilmIsOfferedItAgain() throws Exception {
        ImagePlus monday = filmIn("monday");
        Map<TrackOption, String> values = RememberedOptions.of(monday);
        values.put(TrackOption.OUTPUT, disk.resolve("results").toString());
        RememberedOptions.keep(monday, values);
        values.put(TrackOption.OUTPUT, path("monday"));
        RememberedOptions.keep(monday, values);

        assertThat(RememberedOptions.of(filmIn("tuesday"))).containsEntry(TrackOption.OUTPUT, path("tuesday"));
    }

    @Test
    void aFilmThatLiesInNoFolderHasNoSuggestionAndKeepsTheUsersOwn() {
        ImagePlus unsaved = IJ.createImage("unsaved", "8-bit", 8, 8, 9);
        Map<TrackOption, String> values = RememberedOptions.of(unsaved);
        assertThat(values).containsEntry(TrackOption.OUTPUT, "");

        values.put(TrackOption.OUTPUT, disk.toString());
        RememberedOptions.keep(unsaved, values);
        assertThat(RememberedOptions.of(unsaved)).containsEntry(TrackOption.OUTPUT, disk.toString());
    }

    @Test
    void otherValuesAreRememberedButNotThoseOfTheFilm() throws Exception {
        ImagePlus monday = filmIn("monday");
        Map<TrackOption, String> values = RememberedOptions.of(monday);
        values.put(TrackOption.PRESET, "water");
        values.put(TrackOption.CELL_LENGTH, "9");
        RememberedOptions.keep(monday, values);

        assertThat(RememberedOptions.of(monday))
                .containsEntry(TrackOption.PRESET, "water")
                .containsEntry(TrackOption.CELL_LENGTH, "");
    }

    @Test
    void whatTheOtherPageHoldsIsKnownToBeChanged() throws Exception {
        ImagePlus film = filmIn("monday");
        Map<TrackOption, String> values = RememberedOptions.of(film);
        values.put(TrackOption.PRESET, "water");
        values.put(TrackOption.FRAMES, "z");
        values.put(TrackOption.MAX_AGE, "");
        RememberedOptions.keep(film, values);
        assertThat(RememberedOptions.changeWhatIsNotShown(RememberedOptions.of(film)))
                .isFalse();

        values.put(TrackOption.THRESHOLD_LOW, "0.5");
        RememberedOptions.keep(film, values);
        assertThat(RememberedOptions.changeWhatIsNotShown(RememberedOptions.of(film)))
                .isTrue();
    }

    @Test
    void aChoiceThatIsNoMoreMakesWayForTheDefault() throws Exception {
        Prefs.set("memtrack.preset", "agar");
        Prefs.set("memtrack.association", "overlap");
        assertThat(RememberedOptions.of(filmIn("monday")))
                .containsEntry(TrackOption.PRESET, "collagen")
                .containsEntry(TrackOption.ASSOCIATION, "overlap");
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
