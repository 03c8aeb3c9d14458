// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * MEMTrack inside TrackMate 8: its detector, its tracker, its features and its actions.
 *
 * <p>The only package that links TrackMate; no other package calls it but through {@link
 * org.memtrack.trackmate.TrackMateInstallation}. It speaks TrackMate's language at its edge only: settings are maps and
 * failures are {@code false} with a message there, records and exceptions everywhere else.
 */
@NullMarked
package org.memtrack.trackmate;

import org.jspecify.annotations.NullMarked;
