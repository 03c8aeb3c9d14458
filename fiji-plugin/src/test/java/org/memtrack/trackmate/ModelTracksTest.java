// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import ij.IJ;
import ij.ImagePlus;
import ij.io.FileInfo;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.ImageFilm;

/** What needs no TrackMate; its actions are tested in TrackMate itself. */
class ModelTracksTest {
    private final ImagePlus image = IJ.createImage("film", "8-bit", 8, 8, 1);

    @Test
    void whatTheFilmDoesNotTellIsToldWithARemedyThatTrackMateKnows() {
        assertThat(notes())
                .containsExactly(
                        "The film has no pixel size and no frame interval: speeds are in pixels a frame; set what"
                                + " is missing in Image > Properties and start TrackMate again.");
        image.getCalibration().frameInterval = 0.5;
        assertThat(notes()).singleElement().asString().startsWith("The film has no pixel size: ");
        image.getCalibration().frameInterval = 0;
        image.getCalibration().setUnit("um");
        assertThat(notes()).singleElement().asString().startsWith("The film has no frame interval: ");
    }

    @Test
    void soIsAFrameIntervalThatIsThePlaybackRate() {
        image.getCalibration().setUnit("um");
        image.getCalibration().fps = 50;
        FileInfo source = new FileInfo();
        source.fileName = "film.avi";
        image.setFileInfo(source);
        assertThat(notes())
                .containsExactly(
                        "The frame interval, 0.02000 s, is taken from the film's playback rate; if it was recorded"
                                + " at another rate, set that in Image > Properties and start TrackMate again.");
    }

    @Test
    void ofAFilmThatTellsAllNothingIsSaid() {
        image.getCalibration().setUnit("um");
        image.getCalibration().frameInterval = 0.5;
        assertThat(notes()).isEmpty();
    }

    private List<String> notes() {
        FilmOptions told = new FilmOptions(
                FilmOptions.DEFAULTS.frameAxis(),
                1,
                1,
                0,
                ImageFilm.pixelSizeMicrometres(image),
                ImageFilm.frameIntervalSeconds(image));
        return ModelTracks.calibrationNotes(new ImageFilm(image, told).info(), told);
    }
}
