// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.IJ;
import ij.Macro;
import ij.gui.GenericDialog;
import ij.plugin.PlugIn;
import java.awt.Checkbox;
import java.awt.GraphicsEnvironment;
import java.awt.TextField;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import org.jspecify.annotations.Nullable;
import org.memtrack.detection.DetectorException;
import org.memtrack.macro.GivenPath;
import org.memtrack.server.DataFolder;
import org.memtrack.server.EnvironmentInstaller;
import org.memtrack.server.PythonEnvironment;

/** The command "MEMTrack Install Python Environment": makes or renews the server's environment. */
public final class InstallCommand implements PlugIn {
    @Override
    public void run(String argument) {
        Commands.run(InstallCommand::install);
    }

    private static void install() {
        Optional<Map<String, String>> options = options(Macro.getOptions());
        if (options.isEmpty()) {
            return;
        }
        String python = options.get().getOrDefault("python", "");
        boolean torch = torch(options.get().getOrDefault("torch", "false"));
        PythonEnvironment made = new EnvironmentInstaller()
                .install(python.isEmpty() ? null : GivenPath.of(python), torch, new StatusProgress());
        IJ.log("MEMTrack: the server %s is installed in %s".formatted(made.version(), made.folder()));
        IJ.showStatus("MEMTrack: the Python environment is installed");
    }

    static Optional<Map<String, String>> options(@Nullable String line) {
        if (line != null || GraphicsEnvironment.isHeadless()) {
            return Optional.of(CommandOptions.of(line, "MEMTrack Install Python Environment", "python", "torch"));
        }
        GenericDialog dialog = new GenericDialog("MEMTrack");
        dialog.addMessage(
                "Installs what MEMTrack finds cells with, a Python environment, in\n%s\n".formatted(DataFolder.path())
                        + "About 150 MB are downloaded. An older one is replaced when the new one works.");
        dialog.addStringField("Python program (empty: looked for)", "", 28);
        dialog.addCheckbox("Also PyTorch, for training (several GB)", false);
        dialog.showDialog();
        if (dialog.wasCanceled()) {
            return Optional.empty();
        }
        Map<String, String> options = new LinkedHashMap<>();
        String python = ((TextField) dialog.getStringFields().get(0)).getText().strip();
        if (!python.isEmpty()) {
            options.put("python", python);
        }
        options.put("torch", Boolean.toString(((Checkbox) dialog.getCheckboxes().get(0)).getState()));
        RecordedLine.write(options);
        return Optional.of(options);
    }

    private static boolean torch(String value) {
        if (!value.equals("true") && !value.equals("false")) {
            throw new DetectorException("\"torch=%s\" is not possible: give true or false.".formatted(value));
        }
        return value.equals("true");
    }
}
