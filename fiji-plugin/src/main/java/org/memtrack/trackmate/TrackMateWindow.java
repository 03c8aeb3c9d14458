// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.LoadTrackMatePlugIn;
import java.nio.file.Path;

/** TrackMate's own window; apart from {@link TrackMateInstallation}, which must load without TrackMate. */
final class TrackMateWindow {
    private TrackMateWindow() {}

    static void open(Path file) {
        new LoadTrackMatePlugIn().run(file.toAbsolutePath().toString());
    }
}
