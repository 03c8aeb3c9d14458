// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.motility.MotilityClass;
import org.memtrack.testing.ExaminationData;

/** Files that other programs wrote. */
class ForeignFilesTest {

    private static ImportedTracks trackMate(String name) throws IOException {
        return TrackMateXml.read(ExaminationData.path("trackmate_files", name));
    }

    @ParameterizedTest
    @CsvSource({
        "FakeTracks_v3.4.2.xml, 243, 243, 4, 4, 230",
        "FakeTracks_gapclosing_v6.0.3.xml, 134, 134, 5, 5, 128",
        "FakeTracks_v7.6.0.xml, 84, 84, 2, 2, 82",
        "FakeTracks_v8.0.0-SNAPSHOT.xml, 107, 106, 7, 2, 89"
    })
    void trackMateFilesOfEveryVersionHaveTheirCounts(
            String name, int spots, int visibleSpots, int tracks, int visibleTracks, int links) throws IOException {
        ImportedTracks read = trackMate(name);

        assertThat(read.spots()).hasSize(spots);
        assertThat(read.spots().stream().filter(ImportedSpot::visible)).hasSize(visibleSpots);
        assertThat(read.tracks()).hasSize(tracks);
        assertThat(read.tracks().stream().filter(ImportedTrack::visible)).hasSize(visibleTracks);
        assertThat(read.tracks().stream()
                        .mapToInt(track -> track.links().size())
                        .sum())
                .isEqualTo(links);
        assertThat(read.spots())
                .allMatch(spot -> spot.score().isPresent() && spot.width().isPresent());
        assertThat(read.image()).contains(Path.of("FakeTracks.tif"));
    }

    @Test
    void anExportOfTracksHasItsTracksWithoutSizes() throws IOException {
        ImportedTracks read = trackMate("FakeTracks_simple_tracks_export_v2.4.1.xml");

        assertThat(read.version()).isEqualTo("TrackMate v2.4.1-SNAPSHOT, exported tracks");
        assertThat(read.tracks()).hasSize(4);
        assertThat(read.tracks().get(0).spots()).hasSize(29);
        assertThat(read.tracks().get(0).spots().get(0).frame()).isEqualTo(1);
        assertThat(read.tracks().get(0).spots().get(0).x()).isCloseTo(64.32265546876424, within(1e-12));
        assertThat(read.frameIntervalSeconds()).hasValue(1);
    }

    @Test
    void unitsOfAFileAreKept() throws IOException {
        ImportedTracks pixels = trackMate("FakeTracks_v7.6.0.xml");
        ImportedTracks micrometres = trackMate("FakeTracks_v8.0.0-SNAPSHOT.xml");

        assertThat(pixels.pixelSizeMicrometres()).isEmpty();
        assertThat(pixels.frameIntervalSeconds()).hasValue(1);
        assertThat(micrometres.pixelSizeMicrometres()).hasValue(1);
    }

    @Test
    void spotsAndLinksAreThoseOfTheTablesExportedBesideTheFile() throws IOException {
        ImportedTracks read = trackMate("FakeTracks_gapclosing_v6.0.3.xml");
        List<String> spots =
                Files.readAllLines(ExaminationData.path("trackmate_files", "FakeTracks_gapclosing_v6.0.3_spots.csv"));
        List<String> edges =
                Files.readAllLines(ExaminationData.path("trackmate_files", "FakeTracks_gapclosing_v6.0.3_edges.csv"));
        var spotOf = read.spots().stream().collect(Collectors.toMap(ImportedSpot::id, spot -> spot));
        Set<String> links = new HashSet<>();
        for (ImportedTrack track : read.tracks()) {
            for (ImportedTrack.Link link : track.links()) {
                links.add("%d,%d,%s,%d".formatted(link.sourceId(), link.targetId(), link.cost(), track.id()));
            }
        }

        assertThat(spots).hasSize(135);
        for (String row : spots.subList(1, spots.size())) {
            String[] cells = row.split(",");
            ImportedSpot spot = spotOf.get(Integer.parseInt(cells[1]));
            assertThat(spot.frame()).isEqualTo(Integer.parseInt(cells[2]));
            assertThat(spot.x()).isCloseTo(Double.parseDouble(cells[3]), within(1e-9));
            assertThat(spot.y()).isCloseTo(Double.parseDouble(cells[4]), within(1e-9));
        }
        assertThat(edges).hasSize(129);
        int same = 0;
        for (String row : edges.subList(1, edges.size())) {
            String[] cells = row.split(",");
            String forward = "%s,%s,%s,%s".formatted(cells[1], cells[2], cells[3], cells[4]);
            String backward = "%s,%s,%s,%s".formatted(cells[2], cells[1], cells[3], cells[4]);
            same += links.contains(forward) || links.contains(backward) ? 1 : 0;
        }
        assertThat(same).isEqualTo(128);
    }

    @Test
    void theMtrackjFileHasItsTracksWithTheirGaps() throws IOException {
        ImportedTracks read = Mdf.read(ExaminationData.path("mtrackj_files", "test_mdf.mdf"));

        assertThat(read.version()).isEqualTo("MTrackJ 1.5.1");
        assertThat(read.tracks())
                .extracting(ImportedTrack::name)
                .containsExactly(
                        "Cluster 1 Track 1",
                        "Cluster 1 Track 2",
                        "Cluster 2 Track 1",
                        "Cluster 2 Track 2",
                        "Cluster 2 Track 3");
        assertThat(read.tracks()).extracting(track -> track.spots().size()).containsExactly(2, 3, 1, 2, 2);
        ImportedSpot last = read.tracks().get(1).spots().get(2);
        assertThat(last.frame()).isEqualTo(2);
        assertThat(last.x()).isEqualTo(290.1);
        assertThat(last.y()).isEqualTo(197.5);
    }

    @ParameterizedTest
    @CsvSource({
        "rawdata_rows_1b4288a.csv, ",
        "rawdata_rows_5150532.csv, ",
        "rawdata_rows_e5e4674.csv, HIGH",
        "rawdata_rows_f23eec4.csv, "
    })
    void theAuthorsTablesAreRead(String name, MotilityClass motility) throws IOException {
        Path file = ExaminationData.path("memtrack_notebook", name);

        ImportedTracks read = TrackCsv.read(file);

        assertThat(read.version()).isEqualTo("Raw Data.csv");
        assertThat(read.spots()).hasSize(Files.readAllLines(file).size() - 1);
        assertThat(read.spots().stream().min(Comparator.comparingInt(ImportedSpot::frame)))
                .get()
                .extracting(ImportedSpot::frame)
                .isEqualTo(0);
        assertThat(read.tracks()).extracting(ImportedTrack::id).containsExactly(1);
        assertThat(read.tracks().get(0).motility().orElse(null)).isEqualTo(motility);
    }

    @Test
    void truthTablesAreRead() throws IOException {
        ImportedTracks silver =
                TrackCsv.read(ExaminationData.path("bacteria_water", "bacteria_water_TL_silver_tracks.csv"));
        ImportedTracks rings = TrackCsv.read(ExaminationData.path("trackpy_brightfield", "trackpy_ring_tracks.csv"));

        assertThat(silver.tracks()).isNotEmpty();
        assertThat(rings.spots()).isNotEmpty();
        assertThat(silver.spots().get(0).x()).isEqualTo(432.645);
    }
}
