// SPDX-License-Identifier: GPL-3.0-or-later
/** SORT with interpolation: from detections to tracks, in pixels. */
@NullMarked
package org.memtrack.tracking;

import org.jspecify.annotations.NullMarked;
