// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Files of tracks: TrackMate XML, MTrackJ, CSV, and the provenance beside them.
 *
 * <p>Every writer writes beside its target and then renames, so that nobody sees half a file. Reading
 * throws {@link org.memtrack.formats.FormatException} with one sentence for the user.
 */
@NullMarked
package org.memtrack.formats;

import org.jspecify.annotations.NullMarked;
