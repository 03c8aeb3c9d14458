// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import org.memtrack.detection.DetectorException;

/**
 * The server as a Python package, carried in the plug-in's jar so that both are of one version.
 *
 * @param fileName name of the wheel, which pip reads name and version from
 * @param content the wheel
 */
record ServerWheel(String fileName, byte[] content) {
    private static final String FOLDER = "wheel/";

    /** The wheel in the jar. */
    static ServerWheel fromJar() {
        try (InputStream index = ServerWheel.class.getResourceAsStream(FOLDER + "name.txt")) {
            if (index == null) {
                throw new DetectorException(
                        "This plug-in was built without the server's package: build it with mvn package.");
            }
            String name = new String(index.readAllBytes(), StandardCharsets.UTF_8).strip();
            try (InputStream wheel = ServerWheel.class.getResourceAsStream(FOLDER + name)) {
                if (wheel == null) {
                    throw new DetectorException(
                            "The plug-in's jar is damaged (%s is missing): install it again.".formatted(name));
                }
                return new ServerWheel(name, wheel.readAllBytes());
            }
        } catch (IOException e) {
            throw new DetectorException("The plug-in's jar cannot be read (%s): install it again.".formatted(e), e);
        }
    }

    /** Version of the package, from the file's name. */
    String version() {
        return fileName.split("-")[1];
    }

    Path writeTo(Path folder) throws IOException {
        Files.createDirectories(folder);
        return Files.write(folder.resolve(fileName), content);
    }
}
