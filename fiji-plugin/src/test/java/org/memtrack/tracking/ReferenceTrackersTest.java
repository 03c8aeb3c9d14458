// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tracking;

import java.io.IOException;
import java.nio.file.Path;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.testing.ExaminationData;

/** The authors' mode against what the published SORT and the paper's authors' SORT gave for real detections. */
class ReferenceTrackersTest {

    @ParameterizedTest(name = "{0} {1} {2}")
    @CsvSource({
        "sort_mot15, KITTI-17, ref_sort_default, 1, 3, 0.3",
        "sort_mot15, PETS09-S2L1, ref_sort_default, 1, 3, 0.3",
        "sort_mot15, TUD-Campus, ref_sort_default, 1, 3, 0.3",
        "sort_mot15, TUD-Stadtmitte, ref_sort_default, 1, 3, 0.3",
        "sort_mot15, KITTI-17, ref_memtrack_sort, 25, 0, 0.05",
        "sort_mot15, PETS09-S2L1, ref_memtrack_sort, 25, 0, 0.05",
        "sort_mot15, TUD-Campus, ref_memtrack_sort, 25, 0, 0.05",
        "sort_mot15, TUD-Stadtmitte, ref_memtrack_sort, 25, 0, 0.05",
        "sort_bacteria, bacteria_water_TL, ref_sort_default, 1, 3, 0.3",
        "sort_bacteria, collagen_agar1, ref_sort_default, 1, 3, 0.3",
        "sort_bacteria, bacteria_water_TL, ref_memtrack_age25, 25, 0, 0.05",
        "sort_bacteria, collagen_agar1, ref_memtrack_age25, 25, 0, 0.05",
        "sort_bacteria, bacteria_water_TL, ref_memtrack_age35, 35, 0, 0.05",
        "sort_bacteria, collagen_agar1, ref_memtrack_age35, 35, 0, 0.05"
    })
    void authorsModeEqualsTheReferenceBoxForBox(
            String folder, String sequence, String reference, int maximumAge, int minimumHits, double iouGate)
            throws IOException {
        Path detections = ExaminationData.path(folder, "det", sequence + ".txt");
        Path expected = ExaminationData.path(folder, reference, sequence + ".txt");
        SortSettings settings = new SortSettings(
                Association.OVERLAP,
                iouGate,
                maximumAge,
                minimumHits,
                Interpolation.AUTHORS,
                false,
                TrackFilter.ofLength(1));

        var tracks = new SortTracker(settings).track(TrackerOutput.detections(TrackerOutput.read(detections)));

        TrackerOutput.assertSameUpToIds(TrackerOutput.lines(tracks), TrackerOutput.read(expected));
    }
}
