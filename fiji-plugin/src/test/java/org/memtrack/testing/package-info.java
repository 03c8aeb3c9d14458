// SPDX-License-Identifier: GPL-3.0-or-later
/** What several tests share. */
@NullMarked
package org.memtrack.testing;

import org.jspecify.annotations.NullMarked;
