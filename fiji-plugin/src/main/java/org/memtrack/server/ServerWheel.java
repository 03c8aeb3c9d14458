// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.HexFormat;
import java.util.Optional;
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
        return find().orElseThrow(() -> new DetectorException(
                "This plug-in was built without the server's package: build it with mvn package."));
    }

    /** The wheel in the jar; empty when the plug-in was built without one. */
    static Optional<ServerWheel> find() {
        try (InputStream index = ServerWheel.class.getResourceAsStream(FOLDER + "name.txt")) {
            if (index == null) {
                return Optional.empty();
            }
            String name = new String(index.readAllBytes(), StandardCharsets.UTF_8).strip();
            try (InputStream wheel = ServerWheel.class.getResourceAsStream(FOLDER + name)) {
                if (wheel == null) {
                    throw new DetectorException(
                            "The plug-in's jar is damaged (%s is missing): install it again.".formatted(name));
                }
                return Optional.of(new ServerWheel(name, wheel.readAllBytes()));
            }
        } catch (IOException e) {
            throw new DetectorException("The plug-in's jar cannot be read (%s): install it again.".formatted(e), e);
        }
    }

    /** Version of the package, from the file's name. */
    String version() {
        return fileName.split("-")[1];
    }

    /** SHA-256 of the wheel, hexadecimal: servers of one version may be of different builds. */
    String sha256() {
        try {
            return HexFormat.of().formatHex(MessageDigest.getInstance("SHA-256").digest(content));
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("Every Java has SHA-256", e);
        }
    }

    Path writeTo(Path folder) throws IOException {
        Files.createDirectories(folder);
        return Files.write(folder.resolve(fileName), content);
    }
}
