// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.action.TrackMateAction;
import fiji.plugin.trackmate.action.TrackMateActionFactory;
import ij.ImagePlus;
import ij.io.DirectoryChooser;
import ij.io.FileSaver;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.List;
import java.util.Locale;
import java.util.OptionalDouble;
import java.util.concurrent.CancellationException;
import javax.swing.ImageIcon;
import org.jspecify.annotations.Nullable;
import org.memtrack.formats.AtomicFiles;
import org.memtrack.video.ImageFilm;
import org.scijava.plugin.Plugin;

/** Writes the film and its corrected tracks as data to train on. */
final class TrainingDataAction extends ModelAction {
    /** Offers the action to TrackMate. */
    @Plugin(type = TrackMateActionFactory.class)
    public static final class Factory implements TrackMateActionFactory {
        @Override
        public TrackMateAction create() {
            return new TrainingDataAction();
        }

        @Override
        public String getKey() {
            return "MEMTRACK_TRAINING_DATA";
        }

        @Override
        public String getName() {
            return "Export tracks as MEMTrack training data";
        }

        @Override
        public String getInfoText() {
            return "<html>Writes the film (TIFF), its visible tracks (CSV) and the lines of a training recipe that name both"
                    + " (TOML) into a folder. Correct the tracks first: every bacterium in the film should have one, since what"
                    + " has none is learnt as background.</html>";
        }

        @Override
        public @Nullable ImageIcon getIcon() {
            return MemtrackIcon.SMALL;
        }
    }

    @Override
    void act(ModelTracks tracks) throws IOException {
        String folder = new DirectoryChooser("Folder for the training data").getDirectory();
        if (folder == null) {
            throw new CancellationException();
        }
        export(tracks, Path.of(folder)).forEach(file -> say("Wrote " + file));
    }

    /**
     * Writes film, table and recipe lines, each all or nothing; the recipe lines last.
     *
     * @param folder made if missing, since the dialog lets users type a new one
     */
    static List<Path> export(ModelTracks tracks, Path folder) throws IOException {
        try {
            Files.createDirectories(folder);
        } catch (IOException e) {
            throw new IOException("The folder %s cannot be made: choose another one.".formatted(folder), e);
        }
        String name =
                tracks.info().title().replaceFirst("\\.[A-Za-z0-9]{1,4}$", "").replaceAll("[^\\p{L}\\p{N}_-]+", "_");
        Path film = folder.resolve(name + ".tif");
        Path table = folder.resolve(name + ".csv");
        Path recipe = folder.resolve(name + ".toml");
        for (Path file : List.of(film, table, recipe)) {
            if (Files.exists(file)) {
                throw new IOException(
                        "%s is there already: choose another folder, so that it is not overwritten.".formatted(file));
            }
        }
        writeFilm(tracks.film(), film);
        tracks.write(table);
        String lines = recipe(tracks, film, table);
        AtomicFiles.write(recipe, out -> out.write(lines.getBytes(StandardCharsets.UTF_8)));
        return List.of(film, table, recipe);
    }

    private static void writeFilm(ImageFilm film, Path target) throws IOException {
        FilmStack frames = new FilmStack(film);
        ImagePlus single = new ImagePlus(target.getFileName().toString(), frames);
        single.setDimensions(1, 1, frames.getSize());
        single.setCalibration(film.image().getCalibration());
        Path beside = target.resolveSibling("." + target.getFileName() + ".part.tif");
        try {
            FileSaver saver = new FileSaver(single);
            boolean written = frames.getSize() == 1
                    ? saver.saveAsTiff(beside.toString())
                    : saver.saveAsTiffStack(beside.toString());
            if (!written) {
                throw new IOException("The film cannot be written to %s: make room or choose another folder."
                        .formatted(target.getParent()));
            }
            Files.move(beside, target, StandardCopyOption.REPLACE_EXISTING);
        } finally {
            Files.deleteIfExists(beside);
        }
    }

    private static String recipe(ModelTracks tracks, Path film, Path table) {
        return "# Put these lines into the recipe of a training; the paths are relative to the recipe.\n"
                + "[[annotated]]\n"
                + "film = \"%s\"\n".formatted(film.getFileName())
                + "tracks = \"%s\"\n".formatted(table.getFileName())
                + "role = \"training\"\n"
                + line("pixel_size_um", tracks.info().pixelSizeMicrometres())
                + line("frame_interval_seconds", tracks.info().frameIntervalSeconds());
    }

    private static String line(String key, OptionalDouble value) {
        return value.isPresent() ? String.format(Locale.ROOT, "%s = %s\n", key, value.getAsDouble()) : "";
    }
}
