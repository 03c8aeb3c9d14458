// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import java.io.File;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.lang.reflect.InvocationTargetException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Properties;
import net.imagej.patcher.LegacyEnvironment;

/**
 * An ImageJ of its own, headless, with the shaded plug-in jar and nothing else; runs macros.
 *
 * <p>The system property {@value #JARS} may name further jars, separated as a class path, as they lie in Fiji's folder jars.
 */
public final class MacroSession {
    static final String JARS = "memtrack.jars";

    private final LegacyEnvironment environment;

    /** Starts an ImageJ. The plug-in's jar must have been packaged. */
    public MacroSession() throws IOException, ReflectiveOperationException {
        Path jar = pluginJar();
        if (!Files.isRegularFile(jar)) {
            throw new IllegalStateException("%s is missing: run mvn package first".formatted(jar));
        }
        environment = new LegacyEnvironment(null, true);
        environment.disableIJ1PluginDirs();
        environment.addPluginClasspath(jar.toFile());
        for (String further : System.getProperty(JARS, "").split(File.pathSeparator)) {
            if (!further.isEmpty()) {
                environment.addPluginClasspath(new File(further));
            }
        }
    }

    /** Loads ImageJ's own classes, for what macros cannot do. */
    ClassLoader classes() {
        return environment.getClassLoader();
    }

    /** The shaded plug-in jar of this build. */
    public static Path pluginJar() throws IOException {
        Properties properties = new Properties();
        try (InputStream in = MacroSession.class.getResourceAsStream("build.properties")) {
            properties.load(new InputStreamReader(in, StandardCharsets.UTF_8));
        }
        return Path.of(properties.getProperty("plugin.jar")).normalize();
    }

    /**
     * Runs a macro in the calling thread.
     *
     * @param argument what the macro's {@code getArgument()} gives
     * @return what the macro returned; "[aborted]" when a command failed
     */
    public String run(String macro, String argument) throws ReflectiveOperationException {
        // The first call of the environment brings ImageJ up.
        environment.runMacro("", "");
        ClassLoader loader = environment.getClassLoader();
        Thread thread = Thread.currentThread();
        String name = thread.getName();
        ClassLoader context = thread.getContextClassLoader();
        // ImageJ knows its macros by the name of their thread.
        thread.setName("Run$_" + name);
        thread.setContextClassLoader(loader);
        try {
            Object result = loader.loadClass("ij.IJ")
                    .getMethod("runMacro", String.class, String.class)
                    .invoke(null, macro, argument);
            return result == null ? "" : result.toString();
        } catch (InvocationTargetException e) {
            throw new IllegalStateException(e.getCause());
        } finally {
            thread.setName(name);
            thread.setContextClassLoader(context);
        }
    }
}
