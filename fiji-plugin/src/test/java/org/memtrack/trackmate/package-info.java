// SPDX-License-Identifier: GPL-3.0-or-later
/** Tests of what needs no TrackMate behind its signatures. */
package org.memtrack.trackmate;
