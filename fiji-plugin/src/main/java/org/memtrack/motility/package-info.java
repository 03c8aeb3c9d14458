// SPDX-License-Identifier: GPL-3.0-or-later
/** How fast and how far: speeds, mean squared displacement, diffusivity and the class of motility of a track. */
@NullMarked
package org.memtrack.motility;

import org.jspecify.annotations.NullMarked;
