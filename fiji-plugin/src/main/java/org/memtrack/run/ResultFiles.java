// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.util.List;
import org.memtrack.detection.DetectorException;
import org.memtrack.formats.Mdf;
import org.memtrack.formats.MotilityCsv;
import org.memtrack.formats.Provenance;
import org.memtrack.formats.TrackCsv;
import org.memtrack.formats.TrackMateXml;
import org.memtrack.video.Film;

/**
 * The files of one run, named after the film.
 *
 * @param xml for TrackMate
 * @param csv table, one row a point
 * @param motility table, one row a track
 * @param mdf for MTrackJ
 * @param picture last frame with the tracks, PNG
 * @param provenance settings, versions and counts, JSON; written last
 */
public record ResultFiles(Path xml, Path csv, Path motility, Path mdf, Path picture, Path provenance) {

    /**
     * Where the results of a film will lie; the folder is made if it is missing.
     *
     * @throws DetectorException when the folder cannot be made or written to, or holds files of these names that no run
     *     has written, for example the user's own MTrackJ tracks
     */
    public static ResultFiles in(Path folder, String title) {
        String name = baseName(title);
        ResultFiles files = new ResultFiles(
                folder.resolve(name + ".xml"),
                folder.resolve(name + ".csv"),
                folder.resolve(name + ".motility.csv"),
                folder.resolve(name + ".mdf"),
                folder.resolve(name + ".png"),
                folder.resolve(name + ".json"));
        try {
            Files.createDirectories(folder);
            Files.delete(Files.createTempFile(folder, ".memtrack-", ".part"));
        } catch (IOException e) {
            throw new DetectorException(
                    "The folder %s cannot be written to (%s): choose another one.".formatted(folder, reason(e)), e);
        }
        files.checkReplaceable();
        return files;
    }

    /** All of them. */
    public List<Path> all() {
        return List.of(xml, csv, motility, mdf, picture, provenance);
    }

    /**
     * Writes them, each all or nothing.
     *
     * @param film whose last frame the picture shows
     * @throws DetectorException when one cannot be written
     */
    public void write(TrackingResult result, Film film, Provenance origin) {
        try {
            TrackMateXml.write(xml, result.tracked());
            TrackCsv.write(csv, result.tracked());
            MotilityCsv.write(motility, result.tracked());
            Mdf.write(mdf, result.tracked());
            TrackPicture.of(film, result.tracked()).write(picture);
            origin.write(provenance);
        } catch (IOException e) {
            throw new DetectorException(
                    "The results cannot be written to %s (%s): make room or choose another folder, and run again."
                            .formatted(xml.getParent(), reason(e)),
                    e);
        }
    }

    private void checkReplaceable() {
        List<Path> present = all().stream().filter(Files::exists).toList();
        if (!present.isEmpty() && !writtenByARun()) {
            throw new DetectorException(
                    "%s is there already and is no result of MEMTrack: choose another folder, so that it"
                                    .formatted(present.get(0))
                            + " is not overwritten.");
        }
    }

    private boolean writtenByARun() {
        try {
            Provenance.read(provenance);
            return true;
        } catch (IOException e) {
            return false;
        }
    }

    private static String reason(IOException e) {
        if (e instanceof AccessDeniedException) {
            return "access denied";
        }
        if (e instanceof NoSuchFileException) {
            return "it is gone";
        }
        return e.getMessage() == null ? e.getClass().getSimpleName() : e.getMessage();
    }

    /** Name of the film without the ending of its file, and without what a file system may refuse. */
    static String baseName(String title) {
        String name = title.replaceFirst("(?i)\\.(tiff?|avi|zip|gz|nd2|czi|lif|mp4)$", "")
                .replaceAll("[\\\\/:*?\"<>|\\p{Cntrl}]", "_")
                .replaceAll("^[.\\s]+|[.\\s]+$", "");
        return name.isEmpty() ? "film" : name;
    }
}
