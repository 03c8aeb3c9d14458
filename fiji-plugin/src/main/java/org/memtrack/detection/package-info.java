// SPDX-License-Identifier: GPL-3.0-or-later
/** Boxes found by the detector, in pixels. */
@NullMarked
package org.memtrack.detection;

import org.jspecify.annotations.NullMarked;
