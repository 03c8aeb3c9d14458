// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.LoadTrackMatePlugIn;
import fiji.plugin.trackmate.Model;
import fiji.plugin.trackmate.Settings;
import fiji.plugin.trackmate.io.TmXmlReader;
import ij.ImagePlus;
import ij.measure.Calibration;
import java.io.File;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;
import org.memtrack.video.ImageFilm;

/**
 * TrackMate's own window on a file; apart from {@link TrackMateInstallation}, which must load without TrackMate.
 *
 * <p>TrackMate draws spots by the calibration of the film as its file has it, and would misplace those of a film whose pixel
 * size the user gave; here the film gets the pixel size and frame interval that the tracks were made with. Frames that lie on
 * Z in the file are put on T, or TrackMate would show the tracks of the first frame only.
 */
final class TrackMateWindow extends LoadTrackMatePlugIn {
    private TrackMateWindow() {}

    static void open(Path file) {
        new TrackMateWindow().run(file.toAbsolutePath().toString());
    }

    @Override
    protected TmXmlReader createReader(File file) {
        return new CalibratingReader(file);
    }

    /** Gives the film the calibration of its tracks, and its frames their axis. */
    static final class CalibratingReader extends TmXmlReader {
        private String spaceUnits = "pixel";
        private String timeUnits = "frame";

        CalibratingReader(File file) {
            super(file);
        }

        @Override
        public Model getModel() {
            Model model = super.getModel();
            spaceUnits = model.getSpaceUnits();
            timeUnits = model.getTimeUnits();
            return model;
        }

        @Override
        public @Nullable ImagePlus readImage() {
            ImagePlus film = super.readImage();
            if (film != null && ImageFilm.framesLieOnZ(film)) {
                film.setDimensions(film.getNChannels(), 1, film.getNSlices());
            }
            return film;
        }

        @Override
        public Settings readSettings(ImagePlus film) {
            Settings settings = super.readSettings(film);
            if (settings != null && film != null && settings.dx > 0 && settings.dy > 0) {
                Calibration calibration = film.getCalibration();
                calibration.pixelWidth = settings.dx;
                calibration.pixelHeight = settings.dy;
                calibration.setUnit(spaceUnits);
                calibration.frameInterval = settings.dt;
                calibration.setTimeUnit(timeUnits);
            }
            return settings;
        }
    }
}
