// SPDX-License-Identifier: GPL-3.0-or-later
/** The film: what it is and how its frames are read. */
@NullMarked
package org.memtrack.video;

import org.jspecify.annotations.NullMarked;
