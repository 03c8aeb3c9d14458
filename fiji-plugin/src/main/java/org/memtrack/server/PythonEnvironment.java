// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import com.google.gson.Gson;
import com.google.gson.JsonParseException;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.List;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/**
 * A Python environment that our installer has finished.
 *
 * @param folder where it lies; an environment cannot be moved
 * @param version version of the memtrack package in it
 * @param wheelSha256 SHA-256 of the wheel it was made with, hexadecimal; null when an older plug-in made it, which kept none
 */
public record PythonEnvironment(
        Path folder, String version, @Nullable String wheelSha256) {
    /** Names the environment in use; written last, so that a half-made environment is never in use. */
    private static final String POINTER = "environment.json";

    private record Pointer(
            String folder, String version, @Nullable String wheelSha256) {}

    /** The environment in use in a data folder; empty when there is none or its Python is gone. */
    public static Optional<PythonEnvironment> installed(Path dataFolder) {
        Path pointer = dataFolder.resolve(POINTER);
        if (!Files.isRegularFile(pointer)) {
            return Optional.empty();
        }
        try {
            Pointer read = new Gson().fromJson(Files.readString(pointer, StandardCharsets.UTF_8), Pointer.class);
            if (read == null || read.folder == null || read.version == null) {
                return Optional.empty();
            }
            PythonEnvironment environment =
                    new PythonEnvironment(dataFolder.resolve(read.folder), read.version, read.wheelSha256);
            return Optional.of(environment).filter(e -> Files.isRegularFile(e.python()));
        } catch (IOException | JsonParseException e) {
            return Optional.empty();
        }
    }

    /** Puts this environment into use. */
    void use(Path dataFolder) throws IOException {
        String json = new Gson().toJson(new Pointer(folder.getFileName().toString(), version, wheelSha256));
        Path fresh = dataFolder.resolve(POINTER + ".new");
        Files.writeString(fresh, json, StandardCharsets.UTF_8);
        Files.move(fresh, dataFolder.resolve(POINTER), StandardCopyOption.REPLACE_EXISTING);
    }

    /**
     * That its server is of another build than the plug-in, one sentence; empty when it was made with the plug-in's wheel.
     *
     * @param carried the wheel in the plug-in's jar
     */
    Optional<String> warning(ServerWheel carried) {
        return carried.sha256().equals(wheelSha256)
                ? Optional.empty()
                : Optional.of(
                        ("The server installed in %s is of another build than this plug-in and may not know all of"
                                        + " its options: run Plugins > Tracking > MEMTrack > MEMTrack Install Python Environment"
                                        + " again.")
                                .formatted(folder));
    }

    /** Its interpreter. */
    public Path python() {
        if (!Interpreters.windows()) {
            return folder.resolve("bin").resolve("python");
        }
        Path ofVenv = folder.resolve("Scripts").resolve("python.exe");
        return Files.isRegularFile(ofVenv) ? ofVenv : folder.resolve("python.exe");
    }

    Interpreter interpreter() {
        return new Interpreter(List.of(python().toString()), "installed by MEMTrack", this);
    }
}
