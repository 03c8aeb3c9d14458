// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.IJ;
import ij.Macro;
import ij.plugin.PlugIn;
import ij.text.TextWindow;
import java.awt.GraphicsEnvironment;
import java.nio.file.Path;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;
import org.memtrack.client.ModelCard;
import org.memtrack.client.PluginVersion;
import org.memtrack.client.ServerInfo;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.GivenPath;
import org.memtrack.server.DataFolder;
import org.memtrack.server.EnvironmentInstaller;
import org.memtrack.server.PythonEnvironment;
import org.memtrack.server.ServerConnection;
import org.memtrack.server.ServerSettings;
import org.memtrack.server.Servers;
import org.memtrack.trackmate.TrackMateInstallation;

/** The command "MEMTrack Check Installation": versions, interpreter, devices, models and a round trip, as text to copy. */
public final class CheckCommand implements PlugIn {
    @Override
    public void run(String argument) {
        Commands.run(CheckCommand::check);
    }

    private static void check() {
        ServerSettings settings = settings(Macro.getOptions());
        StringBuilder report = new StringBuilder(ourSide());
        try (ServerConnection connection = Servers.acquire(settings, new StatusProgress())) {
            report.append(serverSide(connection));
            show(report.toString());
            IJ.showStatus("MEMTrack: the server works");
        } catch (DetectorException e) {
            report.append(problem(e.getMessage()));
            show(report.toString());
            throw e;
        }
    }

    static ServerSettings settings(@Nullable String line) {
        Map<String, String> options = CommandOptions.of(line, "MEMTrack Check Installation", "python", "server");
        String python = options.getOrDefault("python", "");
        return new ServerSettings(options.get("server"), python.isEmpty() ? null : GivenPath.of(python));
    }

    private static String ourSide() {
        String environment = PythonEnvironment.installed(DataFolder.path())
                .map(installed -> "%s (server %s)".formatted(installed.folder(), installed.version()))
                .orElse("none in " + DataFolder.path());
        return """
                MEMTrack plug-in: %s
                ImageJ: %s, Java %s, %s %s
                Installed Python environment: %s
                Python carried by a jar: %s
                TrackMate: %s
                """.formatted(
                        PluginVersion.get(),
                        IJ.getVersion(),
                        System.getProperty("java.version"),
                        System.getProperty("os.name"),
                        System.getProperty("os.arch"),
                        environment,
                        EnvironmentInstaller.carriedPython().map(Path::toString).orElse("none"),
                        TrackMateInstallation.problem().orElse("can be used"));
    }

    private static String serverSide(ServerConnection connection) {
        ServerInfo info = connection.client().info(true);
        long start = System.nanoTime();
        connection.client().info(false);
        double milliseconds = (System.nanoTime() - start) / 1e6;
        StringBuilder report = new StringBuilder("""
                Server: memtrack %s, protocol %d, round trip %.1f ms
                Python: %s, %s
                Libraries: %s
                Devices: %s
                Largest film: %.1f GB; free for films at work: %.1f GB
                """.formatted(
                        info.version(),
                        info.protocol(),
                        milliseconds,
                        info.pythonVersion(),
                        connection.origin(),
                        libraries(info),
                        String.join(", ", info.devices()),
                        info.maxFilmBytes() / 1e9,
                        info.spoolFreeBytes() / 1e9));
        for (ModelCard model : connection.client().models()) {
            report.append("Model: %s %s, SHA-256 %s%n    %s%n"
                    .formatted(model.name(), model.version(), model.sha256(), model.description()));
        }
        for (String warning : connection.warnings()) {
            report.append(Commands.wrapped(warning)).append("\n");
        }
        if (connection.warnings().isEmpty() && !info.version().equals(PluginVersion.get())) {
            report.append(
                    "The server is of another version than the plug-in: run \"MEMTrack Install Python Environment\".\n");
        }
        return report.toString();
    }

    /** In lines that the window shows without scrolling. */
    static String problem(String sentence) {
        return Commands.wrapped("Server: " + sentence) + "\n";
    }

    private static String libraries(ServerInfo info) {
        return new TreeMap<>(info.libraries())
                .entrySet().stream()
                        .map(library -> library.getKey() + " " + library.getValue())
                        .collect(Collectors.joining(", "));
    }

    private static void show(String report) {
        if (GraphicsEnvironment.isHeadless()) {
            IJ.log(report);
        } else {
            new TextWindow("MEMTrack: installation", report, 800, 400);
        }
    }
}
