// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import com.google.gson.Gson;
import com.google.gson.GsonBuilder;
import com.google.gson.JsonParseException;
import com.google.gson.ToNumberPolicy;
import java.io.IOException;
import java.io.Reader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

/**
 * Where a result comes from: enough to repeat the run. Written as JSON beside the tracks.
 *
 * @param created when, ISO 8601 in UTC
 * @param software name to version: the plug-in, the server, ImageJ, Java, the system
 * @param film name to value: title, file (or what it was opened from and is no more), sha256, width, height, frames, pixel
 *     size and frame interval
 * @param model name to value: name, version, sha256, engine, thresholds; empty when nothing was detected
 * @param settings name to value: all that was in force in this run, defaults and the selected region included
 * @param counts name to count: what the detector found, what each filter dropped, tracks and points
 * @param seconds stage of the detection to its wall time
 * @param warnings what the user was told, one sentence each
 * @param files name to SHA-256 of the files that the run wrote beside this one
 */
public record Provenance(
        String created,
        Map<String, String> software,
        Map<String, Object> film,
        Map<String, Object> model,
        Map<String, Object> settings,
        Map<String, Long> counts,
        Map<String, Double> seconds,
        List<String> warnings,
        Map<String, String> files) {
    private static final Gson GSON = new GsonBuilder()
            .setPrettyPrinting()
            .disableHtmlEscaping()
            .setObjectToNumberStrategy(ToNumberPolicy.LONG_OR_DOUBLE)
            .create();

    public Provenance {
        // JSON that some other program wrote may lack them.
        software = software == null ? Map.of() : software;
        film = film == null ? Map.of() : film;
        files = files == null ? Map.of() : files;
    }

    /** The same, of a run that wrote these files, and told the user these warnings besides. */
    public Provenance with(Map<String, String> newFiles, List<String> further) {
        List<String> all = Stream.concat(warnings.stream(), further.stream()).toList();
        return new Provenance(created, software, film, model, settings, counts, seconds, all, newFiles);
    }

    /** Writes it as JSON, all or nothing. */
    public void write(Path target) throws IOException {
        byte[] json = (GSON.toJson(this) + "\n").getBytes(StandardCharsets.UTF_8);
        AtomicFiles.write(target, out -> out.write(json));
    }

    /**
     * Reads what {@link #write} wrote.
     *
     * @throws FormatException when the file is no provenance
     */
    public static Provenance read(Path source) throws IOException {
        try (Reader reader = Files.newBufferedReader(source, StandardCharsets.UTF_8)) {
            Provenance provenance = GSON.fromJson(reader, Provenance.class);
            if (provenance != null) {
                return provenance;
            }
        } catch (JsonParseException | IllegalArgumentException e) {
            throw new FormatException("%s is no provenance of MEMTrack: %s".formatted(source, e.getMessage()), e);
        }
        throw new FormatException("%s is no provenance of MEMTrack: it is empty".formatted(source));
    }
}
