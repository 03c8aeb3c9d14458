// SPDX-License-Identifier: GPL-3.0-or-later
/** Calls of the detection server; the generated messages of the contract stay inside. */
@NullMarked
package org.memtrack.client;

import org.jspecify.annotations.NullMarked;
