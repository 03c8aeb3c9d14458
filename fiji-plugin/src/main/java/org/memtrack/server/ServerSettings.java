// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.nio.file.Path;
import org.jspecify.annotations.Nullable;

/**
 * Where the detection server comes from.
 *
 * @param address "host:port" of a server that someone else runs, whose token is in the environment variable
 *     MEMTRACK_TOKEN; null to use one of our own
 * @param python interpreter to start our own with; null to look for one, see {@link Servers#acquire}
 */
public record ServerSettings(
        @Nullable String address, @Nullable Path python) {
    /** A server of our own, with an interpreter that is looked for. */
    public static final ServerSettings DEFAULTS = new ServerSettings(null, null);
}
