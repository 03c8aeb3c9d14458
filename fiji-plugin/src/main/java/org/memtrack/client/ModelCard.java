// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

/**
 * A model the server has.
 *
 * @param name name, [a-z0-9_.-]{1,64}
 * @param version version, for example "1.0.0"
 * @param description one or two sentences: what it was trained on, what it is for
 * @param sha256 SHA-256 of the card, which states those of the weights, hexadecimal
 */
public record ModelCard(String name, String version, String description, String sha256) {}
