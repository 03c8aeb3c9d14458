// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class EvaluationSummaryTest {
    @TempDir
    private Path folder;

    @Test
    void theMeasuresAreSentences() throws IOException {
        assertThat(EvaluationSummary.of(json("""
                        {"all_films": {"precision": 0.9, "recall": 0.5, "F1": 0.643, "HOTA": 0.41, "MOTA": 0.3,
                        "IDF1": 0.55, "RMSE_px": 1.26, "truth_tracks": 11, "tracks": 9, "false_tracks": 2},
                        "films": {"truth": {"precision": 0.1}}}""")))
                .containsExactly(
                        "Boxes, frame by frame: precision 0.900, recall 0.500, F1 0.643; 1 is best.",
                        "Tracks: HOTA 0.410, MOTA 0.300, IDF1 0.550; 1 is best. Error of the centres, root mean square, in pixels: 1.3.",
                        "Tracks in the truth: 11. Compared with it: 9, of which 2 false, with fewer than half of their points right.");
    }

    @Test
    void anUndefinedMeasureIsCalledSo() throws IOException {
        assertThat(EvaluationSummary.of(json("""
                        {"all_films": {"precision": null, "recall": 0.0, "F1": 0.0, "HOTA": 0.0, "MOTA": 0.0,
                        "IDF1": 0.0, "RMSE_px": null, "truth_tracks": 3, "tracks": 0, "false_tracks": 0}}""")))
                .contains(
                        "Boxes, frame by frame: precision undefined, recall 0.000, F1 0.000; 1 is best.",
                        "Tracks: HOTA 0.000, MOTA 0.000, IDF1 0.000; 1 is best. Error of the centres, root mean square, in pixels: undefined.");
    }

    private Path json(String text) throws IOException {
        return Files.writeString(folder.resolve("evaluation.json"), text);
    }
}
