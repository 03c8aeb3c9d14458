// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.nio.file.Path;
import java.util.Locale;
import java.util.Map;
import org.memtrack.detection.DetectorException;

/** The folder of this user where MEMTrack keeps its Python environment. */
public final class DataFolder {
    private DataFolder() {}

    /**
     * The folder named by MEMTRACK_HOME, or the system's usual place for a program's data; it need not exist.
     *
     * @throws DetectorException when what a variable holds is no path
     */
    public static Path path() {
        return path(System.getenv(), System.getProperty("os.name", ""), Path.of(System.getProperty("user.home", ".")));
    }

    static Path path(Map<String, String> environment, String system, Path userHome) {
        String given = environment.getOrDefault("MEMTRACK_HOME", "");
        if (!given.isBlank()) {
            return VariablePath.of("MEMTRACK_HOME", given).toAbsolutePath();
        }
        String name = system.toLowerCase(Locale.ROOT);
        if (name.startsWith("windows")) {
            String local = environment.get("LOCALAPPDATA");
            return (local == null
                            ? userHome.resolve("AppData").resolve("Local")
                            : VariablePath.of("LOCALAPPDATA", local))
                    .resolve("MEMTrack");
        }
        if (name.startsWith("mac")) {
            return userHome.resolve("Library").resolve("Application Support").resolve("MEMTrack");
        }
        String data = environment.getOrDefault("XDG_DATA_HOME", "");
        return (data.isBlank() ? userHome.resolve(".local").resolve("share") : VariablePath.of("XDG_DATA_HOME", data))
                .resolve("memtrack");
    }
}
