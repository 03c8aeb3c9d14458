// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.Properties;

/** Version of this plug-in, as the build wrote it. */
public final class PluginVersion {
    private PluginVersion() {}

    public static String get() {
        try (InputStream in = PluginVersion.class.getResourceAsStream("/org/memtrack/memtrack.properties")) {
            if (in == null) {
                throw new IllegalStateException("The plug-in's jar is damaged: memtrack.properties is missing");
            }
            Properties properties = new Properties();
            properties.load(new InputStreamReader(in, StandardCharsets.UTF_8));
            return properties.getProperty("version");
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }
}
