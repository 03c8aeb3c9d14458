// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;
import org.memtrack.video.FilmInfo;

/**
 * Settings of a TrackMate file, by which TrackMate finds the film.
 *
 * <p>Detector and tracker are TrackMate's manual ones, so that the file opens without our plug-in too.
 */
final class TrackMateXmlSettings {
    /** Of spots that the user adds by hand: half the box of the paper's detector. */
    private static final double DEFAULT_RADIUS_PIXELS = 15;

    private TrackMateXmlSettings() {}

    /**
     * Writes them.
     *
     * @param file where the film is, absolute
     */
    static void write(IndentedXml xml, FilmInfo film, Path file) throws IOException {
        double pixelSize = film.pixelSizeMicrometres().orElse(1);
        double interval = film.frameIntervalSeconds().orElse(1);
        Path folder = file.getParent();
        xml.start("Settings");
        xml.empty(
                "ImageData",
                "filename",
                file.getFileName() == null ? "" : file.getFileName().toString(),
                "folder",
                folder == null ? "" : folder + file.getFileSystem().getSeparator(),
                "width",
                Integer.toString(film.width()),
                "height",
                Integer.toString(film.height()),
                "nslices",
                "1",
                "nframes",
                Integer.toString(film.frameCount()),
                "pixelwidth",
                Double.toString(pixelSize),
                "pixelheight",
                Double.toString(pixelSize),
                "voxeldepth",
                "1.0",
                "timeinterval",
                Double.toString(interval));
        xml.empty(
                "BasicSettings",
                "xstart",
                "0",
                "xend",
                Integer.toString(film.width() - 1),
                "ystart",
                "0",
                "yend",
                Integer.toString(film.height() - 1),
                "zstart",
                "0",
                "zend",
                "0",
                "tstart",
                "0",
                "tend",
                Integer.toString(film.frameCount() - 1));
        xml.empty(
                "DetectorSettings",
                "DETECTOR_NAME",
                "MANUAL_DETECTOR",
                "RADIUS",
                Double.toString(DEFAULT_RADIUS_PIXELS * pixelSize));
        xml.empty("InitialSpotFilter", "feature", "QUALITY", "value", "0.0", "isabove", "true");
        xml.empty("SpotFilterCollection");
        xml.empty("TrackerSettings", "TRACKER_NAME", "MANUAL_TRACKER");
        xml.empty("TrackFilterCollection");
        xml.start("AnalyzerCollection");
        xml.empty("SpotAnalyzers");
        xml.empty("EdgeAnalyzers");
        xml.empty("TrackAnalyzers");
        xml.end();
        xml.end();
    }
}
