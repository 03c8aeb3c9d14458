// SPDX-License-Identifier: GPL-3.0-or-later
/** The options of the macro language, from which dialog, recorder and manual derive. */
@NullMarked
package org.memtrack.macro;

import org.jspecify.annotations.NullMarked;
