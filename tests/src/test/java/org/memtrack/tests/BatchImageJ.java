// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import net.imagej.patcher.LegacyEnvironment;

/** Headless ImageJ as a command line starts it, with the plug-in's jar; the arguments are ImageJ's own. */
public final class BatchImageJ {
    private BatchImageJ() {}

    public static void main(String[] arguments) throws Exception {
        LegacyEnvironment environment = new LegacyEnvironment(null, true);
        environment.disableIJ1PluginDirs();
        environment.addPluginClasspath(MacroSession.pluginJar().toFile());
        environment.main(arguments);
    }
}
