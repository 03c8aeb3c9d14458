// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.util.List;

/**
 * What the server does with a film, told before work begins and anew where the film is found to be a crowd, for which the
 * model names another.
 *
 * @param name name of the model
 * @param version version of the model
 * @param sha256 SHA-256 of the model's card, which states those of its weights, hexadecimal
 * @param thresholds thresholds in force
 * @param scale factor by which frames are enlarged, or below 1 shrunk, to bring cells to a length the model knows; 1 when
 *     they are used as they are
 * @param engine computing engine, for example "openvino 2026.4 CPU"
 * @param warnings what the user should know about this film and these settings, one sentence each
 */
public record ModelInUse(
        String name,
        String version,
        String sha256,
        Thresholds thresholds,
        double scale,
        String engine,
        List<String> warnings) {
    public ModelInUse {
        warnings = List.copyOf(warnings);
    }
}
