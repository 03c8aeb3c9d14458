// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import java.util.List;
import java.util.Locale;
import java.util.Map;

/**
 * What was kept and what each filter dropped, over the whole film, in the order of the filters.
 *
 * @param frameCount frames of the film
 * @param candidates boxes above the detector's own floor
 * @param tooLarge dropped as wider or taller than the greatest size
 * @param nearMisses dropped by the threshold of their level
 * @param overlapping dropped as overlapping a better one
 * @param outsideRegion dropped as outside the region
 * @param kept detections reported
 * @param candidateFloor score below which the detector reports no candidate, in [0, 1]
 * @param filmSha256 SHA-256 of the samples as the server received them, hexadecimal
 * @param secondsByStage wall time of each stage, in seconds, by the stage's name, in order
 * @param warnings what the user should know about the film that only its frames told, one sentence each
 */
public record DetectionSummary(
        int frameCount,
        long candidates,
        long tooLarge,
        long nearMisses,
        long overlapping,
        long outsideRegion,
        long kept,
        double candidateFloor,
        String filmSha256,
        Map<String, Double> secondsByStage,
        List<String> warnings) {
    public DetectionSummary {
        warnings = List.copyOf(warnings);
    }

    /** One sentence for the user; an honest zero tells what lower thresholds would have let through. */
    public String describe(Thresholds thresholds) {
        String above = thresholds.low() == thresholds.medium() && thresholds.medium() == thresholds.high()
                ? String.format(Locale.ROOT, "%.2f", thresholds.low())
                : String.format(
                        Locale.ROOT,
                        "%.2f (low), %.2f (medium), %.2f (high)",
                        thresholds.low(),
                        thresholds.medium(),
                        thresholds.high());
        return String.format(
                Locale.ROOT,
                "%d detections above %s; %d weaker boxes, down to %.2f and several on each cell, are not among them",
                kept,
                above,
                nearMisses,
                candidateFloor);
    }
}
