// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.run;

import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import org.jspecify.annotations.Nullable;
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
 * @param picture last frame with the tracks, PNG; missing when it could not be drawn
 * @param provenance settings, versions, counts and the hashes of the other files, JSON; written last
 */
public record ResultFiles(Path xml, Path csv, Path motility, Path mdf, Path picture, Path provenance) {

    /**
     * Where the results of a film will lie; the folder is made if it is missing.
     *
     * @throws DetectorException when the folder cannot be made or written to, holds the results of another film of that
     *     name, or files of these names that are not as a run has left them, for example tracks that the user has made or
     *     corrected
     */
    public static ResultFiles in(Path folder, Film film) {
        String name = baseName(film.info().title());
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
        files.checkReplaceable(film);
        return files;
    }

    /** All of them. */
    public List<Path> all() {
        return List.of(xml, csv, motility, mdf, picture, provenance);
    }

    /**
     * Writes all of them or, where one cannot be written, none; files of an earlier run are replaced when these are complete.
     * For a picture that cannot be drawn no tracks are given up.
     *
     * @param film whose last frame the picture shows; it is read anew
     * @return one sentence when the picture is missing
     * @throws DetectorException when one cannot be written; or when those of an earlier run cannot be replaced, as the user
     *     has changed one meanwhile or another program has it open: then the new ones stay in a folder that the message names
     */
    public Optional<String> write(TrackingResult result, Film film, Provenance origin) {
        try (StagedFiles staged = new StagedFiles(folder())) {
            TrackMateXml.write(staged.of(xml), result.tracked());
            TrackCsv.write(staged.of(csv), result.tracked());
            MotilityCsv.write(staged.of(motility), result.tracked());
            Mdf.write(staged.of(mdf), result.tracked());
            Optional<String> undrawn = draw(result, film, staged.of(picture));
            Map<String, String> hashes = new LinkedHashMap<>();
            for (Path file : List.of(xml, csv, motility, mdf, picture)) {
                if (Files.exists(staged.of(file))) {
                    hashes.put(name(file), Sha256.of(staged.of(file)));
                }
            }
            origin.with(hashes, undrawn.stream().toList()).write(staged.of(provenance));
            replaceBy(staged, film);
            return undrawn;
        } catch (IOException e) {
            throw new DetectorException(
                    "The results cannot be written to %s (%s): make room, close what has them open, or choose another folder, and run again."
                            .formatted(folder(), reason(e)),
                    e);
        }
    }

    /**
     * One sentence when it fails: the film's disk may be gone, or a huge frame be too much for the memory. Any Error is
     * caught, since a Java without fonts throws an InternalError, and tracks are worth more than their picture.
     */
    private static Optional<String> draw(TrackingResult result, Film film, Path target) {
        try {
            TrackPicture.of(film, result.tracked()).write(target);
            return Optional.empty();
        } catch (IOException | RuntimeException | Error e) {
            System.getLogger("org.memtrack").log(System.Logger.Level.INFO, "No picture", e);
            return Optional.of(
                    "The picture of the tracks is missing, since it could not be drawn (%s); all other results are there."
                            .formatted(
                                    e instanceof OutOfMemoryError
                                            ? "the memory is full"
                                            : reason(e).replaceFirst("\\.$", "")));
        }
    }

    private void replaceBy(StagedFiles staged, Film film) {
        try {
            checkReplaceable(film);
            staged.moveTo(all());
        } catch (DetectorException e) {
            throw new DetectorException(
                    "The results of this run were left in %s, since %s".formatted(staged.keep(), e.getMessage()), e);
        } catch (IOException e) {
            throw new DetectorException(
                    "The results of this run were left in %s, since they cannot replace those in %s (%s): close what has these open, and move them there."
                            .formatted(staged.keep(), folder(), reason(e)),
                    e);
        }
    }

    /** The folder they lie in. */
    public Path folder() {
        return provenance.resolveSibling("");
    }

    private void checkReplaceable(Film film) {
        Optional<Provenance> earlier = earlierRun();
        earlier.flatMap(ResultFiles::filmOf)
                .filter(other -> isOfAnother(film, other))
                .ifPresent(other -> {
                    throw new DetectorException(
                            "%s holds the results of another film of this name, %s: give another output folder."
                                    .formatted(folder(), other));
                });
        // Those of an earlier version have no hashes.
        Map<String, String> written = earlier.map(Provenance::files).orElse(Map.of());
        for (Path file : all()) {
            boolean ours = file.equals(provenance) ? !written.isEmpty() : hasHash(file, written.get(name(file)));
            if (Files.exists(file) && !ours) {
                throw new DetectorException(
                        "%s is there already, and is no result of MEMTrack or was changed since: move it away or choose another folder, so that it is not overwritten."
                                .formatted(file));
            }
        }
    }

    /** What an earlier run noted; empty when there was none. */
    private Optional<Provenance> earlierRun() {
        try {
            return Optional.of(Provenance.read(provenance))
                    .filter(earlier -> earlier.software().containsKey(Origin.PLUGIN));
        } catch (IOException e) {
            return Optional.empty();
        }
    }

    /** The file or folder of the film of an earlier run; empty when it came from none, or from one on another system. */
    private static Optional<Path> filmOf(Provenance earlier) {
        Object place = earlier.film().getOrDefault(Origin.FILE, earlier.film().get(Origin.OPENED_FROM));
        try {
            return place instanceof String text
                    ? Optional.of(Path.of(text)).filter(Path::isAbsolute)
                    : Optional.empty();
        } catch (InvalidPathException e) {
            return Optional.empty();
        }
    }

    /** Whether a file, or folder of pictures, holds another film; not when it is gone, since films are moved. */
    private static boolean isOfAnother(Film film, Path place) {
        Path own = film.openedFrom().orElse(place);
        if (own.equals(place) || !Files.exists(place)) {
            return false;
        }
        try {
            return Files.isRegularFile(own) && Files.isRegularFile(place)
                    ? Files.mismatch(own, place) >= 0
                    : !Files.isSameFile(own, place);
        } catch (IOException e) {
            return true;
        }
    }

    private static boolean hasHash(Path file, @Nullable String hash) {
        try {
            return hash != null && hash.equals(Sha256.of(file));
        } catch (IOException e) {
            return false;
        }
    }

    private static String name(Path file) {
        return file.getFileName().toString();
    }

    private static String reason(Throwable e) {
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
