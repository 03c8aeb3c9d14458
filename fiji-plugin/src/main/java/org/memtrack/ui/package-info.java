// SPDX-License-Identifier: GPL-3.0-or-later
/** Menu commands, dialog and progress. */
@NullMarked
package org.memtrack.ui;

import org.jspecify.annotations.NullMarked;
