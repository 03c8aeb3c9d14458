// SPDX-License-Identifier: GPL-3.0-or-later
/** Headless ImageJ with the shaded plug-in jar, for the command line and for tests of the whole. */
package org.memtrack.tests;
