// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import com.google.gson.JsonElement;
import com.google.gson.JsonObject;
import com.google.gson.JsonParser;
import java.io.IOException;
import java.io.Reader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;

/** What a comparison with a ground truth found, in sentences: TrackMate's log is too narrow for its table. */
final class EvaluationSummary {
    private EvaluationSummary() {}

    /**
     * Reads the measures over the whole film.
     *
     * @param json the evaluation.json that {@code memtrack evaluate} wrote
     */
    static List<String> of(Path json) throws IOException {
        JsonObject measures;
        try (Reader reader = Files.newBufferedReader(json)) {
            measures = JsonParser.parseReader(reader).getAsJsonObject().getAsJsonObject("all_films");
        }
        return List.of(
                "Boxes, frame by frame: precision %s, recall %s, F1 %s; 1 is best."
                        .formatted(
                                number(measures, "precision", 3),
                                number(measures, "recall", 3),
                                number(measures, "F1", 3)),
                "Tracks: HOTA %s, MOTA %s, IDF1 %s; 1 is best. Error of the centres, root mean square, in pixels: %s."
                        .formatted(
                                number(measures, "HOTA", 3),
                                number(measures, "MOTA", 3),
                                number(measures, "IDF1", 3),
                                number(measures, "RMSE_px", 1)),
                "Tracks in the truth: %s. Compared with it: %s, of which %s false, with fewer than half of their points right."
                        .formatted(
                                number(measures, "truth_tracks", 0),
                                number(measures, "tracks", 0),
                                number(measures, "false_tracks", 0)));
    }

    /** A measure; "undefined" where it has no value, as the precision of no track. */
    private static String number(JsonObject measures, String name, int decimals) {
        JsonElement value = measures.get(name);
        return value == null || value.isJsonNull()
                ? "undefined"
                : String.format(Locale.ROOT, "%." + decimals + "f", value.getAsDouble());
    }
}
