// SPDX-License-Identifier: GPL-3.0-or-later
/** One run from film to files: detection, tracking, outputs. */
@NullMarked
package org.memtrack.run;

import org.jspecify.annotations.NullMarked;
