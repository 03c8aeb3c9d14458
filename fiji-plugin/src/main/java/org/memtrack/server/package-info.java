// SPDX-License-Identifier: GPL-3.0-or-later
/** Finds, starts, watches and ends the local Python server, and installs its environment. */
@NullMarked
package org.memtrack.server;

import org.jspecify.annotations.NullMarked;
