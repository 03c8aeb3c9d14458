// SPDX-License-Identifier: GPL-3.0-or-later
/** Tests inside the real TrackMate; run with the profile "fiji". */
package org.memtrack.trackmate;
