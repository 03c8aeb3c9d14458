// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.OptionalDouble;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.motility.MotilityClass;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;

/** What each writer writes can be read back. */
class RoundTripTest {
    @TempDir
    Path folder;

    @ParameterizedTest
    @CsvSource({"1, true, FILL_GAPS", "2, false, FILL_GAPS", "3, true, AUTHORS", "4, false, AUTHORS"})
    void trackMateXmlKeepsEverything(long seed, boolean calibrated, Interpolation interpolation) throws IOException {
        TrackedFilm tracked = TrackedWorlds.of(seed, calibrated, interpolation);
        Path file = folder.resolve("tracks ü [水].xml");

        TrackMateXml.write(file, tracked);
        ImportedTracks read = TrackMateXmlReader.read(file);

        assertThat(read.version()).isEqualTo("TrackMate 7.14.0");
        assertThat(read.image()).isEqualTo(tracked.film().file());
        assertSame(tracked, read, 1e-9);
        for (int i = 0; i < read.tracks().size(); i++) {
            assertThat(read.tracks().get(i).motility())
                    .isEqualTo(tracked.motility().get(i).motilityClass());
            assertThat(read.tracks().get(i).linkCosts())
                    .hasSize(tracked.tracks().get(i).points().size() - 1);
            assertThat(read.tracks().get(i).spots())
                    .allMatch(spot -> spot.interpolated() != spot.contrast().isPresent());
        }
        if (calibrated) {
            assertThat(read.pixelSizeMicrometres().getAsDouble()).isCloseTo(0.2475, within(1e-12));
            assertThat(read.frameIntervalSeconds().getAsDouble()).isCloseTo(1 / 60.0, within(1e-12));
        } else {
            assertThat(read.pixelSizeMicrometres()).isEmpty();
            assertThat(read.frameIntervalSeconds()).isEmpty();
        }
    }

    @Test
    void linksCostOneMinusTheOverlapOfTheirBoxes() throws IOException {
        TrackedFilm tracked = TrackedWorlds.of(5, true, Interpolation.FILL_GAPS);
        Path file = folder.resolve("tracks.xml");

        TrackMateXml.write(file, tracked);

        List<TrackPoint> points = tracked.tracks().get(2).points();
        ImportedTrack read = TrackMateXmlReader.read(file).tracks().get(2);
        assertThat(read.linkCosts()).hasSize(points.size() - 1);
        for (int i = 1; i < points.size(); i++) {
            assertThat(read.linkCosts().get(i - 1))
                    .isCloseTo(1 - points.get(i).box().iou(points.get(i - 1).box()), within(1e-12));
        }
    }

    @ParameterizedTest
    @CsvSource({"6, true", "12, false"})
    void theDriftOfTheStageIsReadBackAndWithItTheMotility(long seed, boolean calibrated) throws IOException {
        TrackedFilm tracked = TrackedWorlds.of(seed, calibrated, Interpolation.FILL_GAPS, 1.5);
        Path file = folder.resolve("tracks.xml");

        TrackMateXml.write(file, tracked);
        ImportedTracks read = TrackMateXmlReader.read(file);

        List<FrameDetections> drift = read.spots().stream()
                .map(spot -> new FrameDetections(
                        spot.frame(),
                        List.of(),
                        spot.driftX().getAsDouble(),
                        spot.driftY().getAsDouble()))
                .toList();
        assertThat(drift).hasSizeGreaterThan(50).allSatisfy(frame -> {
            assertThat(frame.driftX()).isCloseTo(1.5 * frame.frame(), within(1e-9));
            assertThat(frame.driftY()).isCloseTo(-0.75 * frame.frame(), within(1e-9));
        });
        List<Track> tracks = read.tracks().stream().map(RoundTripTest::asRead).toList();
        assertThat(motilityTable(TrackedFilm.of(tracked.film(), tracks, drift))).isEqualTo(motilityTable(tracked));
        assertThat(motilityTable(TrackedFilm.of(tracked.film(), tracks, List.of())))
                .as("the drift taken for swimming")
                .isNotEqualTo(motilityTable(tracked));
    }

    private static Track asRead(ImportedTrack track) {
        return new Track(
                track.id(),
                track.spots().stream()
                        .map(spot -> {
                            Box box = Box.around(
                                    spot.x(),
                                    spot.y(),
                                    spot.width().getAsDouble(),
                                    spot.height().getAsDouble());
                            return new TrackPoint(
                                    spot.frame(),
                                    box,
                                    spot.interpolated()
                                            ? null
                                            : new Detection(box, spot.score().getAsDouble(), spot.level()));
                        })
                        .toList());
    }

    private String motilityTable(TrackedFilm tracked) throws IOException {
        Path file = folder.resolve("motility.csv");
        MotilityCsv.write(file, tracked);
        return Files.readString(file);
    }

    @ParameterizedTest
    @CsvSource({"7, true, FILL_GAPS", "8, false, AUTHORS"})
    void csvKeepsEverythingToFourDecimals(long seed, boolean calibrated, Interpolation interpolation)
            throws IOException {
        TrackedFilm tracked = TrackedWorlds.of(seed, calibrated, interpolation);
        Path file = folder.resolve("tracks.csv");

        TrackCsv.write(file, tracked);
        ImportedTracks read = TrackCsvReader.read(file);

        assertSame(tracked, read, 5.1e-5);
        for (int i = 0; i < read.tracks().size(); i++) {
            assertThat(read.tracks().get(i).motility())
                    .isEqualTo(tracked.motility().get(i).motilityClass());
        }
    }

    @ParameterizedTest
    @CsvSource({"9, true, FILL_GAPS", "10, false, AUTHORS"})
    void mdfKeepsPlacesAndWhatIsInterpolated(long seed, boolean calibrated, Interpolation interpolation)
            throws IOException {
        TrackedFilm tracked = TrackedWorlds.of(seed, calibrated, interpolation);
        Path file = folder.resolve("tracks.mdf");

        Mdf.write(file, tracked);
        ImportedTracks read = MdfReader.read(file);

        assertThat(read.version()).isEqualTo("MTrackJ 1.5.1");
        assertThat(read.tracks()).hasSameSizeAs(tracked.tracks());
        for (Track track : tracked.tracks()) {
            ImportedTrack same = read.tracks().stream()
                    .filter(imported -> imported.name().endsWith(" Track " + (track.id() + 1)))
                    .findFirst()
                    .orElseThrow();
            assertThat(same.spots()).hasSameSizeAs(track.points());
            for (int i = 0; i < track.points().size(); i++) {
                assertSamePlace(track.points().get(i), same.spots().get(i), 5.1e-5);
            }
        }
    }

    private static void assertSame(TrackedFilm tracked, ImportedTracks read, double tolerance) {
        assertThat(tracked.tracks()).hasSizeGreaterThan(5);
        assertThat(read.tracks()).hasSameSizeAs(tracked.tracks());
        int interpolated = 0;
        for (int i = 0; i < read.tracks().size(); i++) {
            Track track = tracked.tracks().get(i);
            ImportedTrack same = read.tracks().get(i);
            assertThat(same.id()).isEqualTo(track.id());
            assertThat(same.spots()).hasSameSizeAs(track.points());
            for (int j = 0; j < track.points().size(); j++) {
                TrackPoint point = track.points().get(j);
                ImportedSpot spot = same.spots().get(j);
                Detection detection = point.detection();
                interpolated += point.interpolated() ? 1 : 0;
                assertSamePlace(point, spot, tolerance);
                assertThat(spot.width().getAsDouble()).isCloseTo(point.box().width(), within(tolerance));
                assertThat(spot.height().getAsDouble()).isCloseTo(point.box().height(), within(tolerance));
                assertThat(spot.level()).isEqualTo(detection == null ? Level.UNSPECIFIED : detection.level());
                if (detection == null) {
                    assertThat(spot.score()).isEqualTo(OptionalDouble.empty());
                    assertThat(spot.positionError()).isEqualTo(OptionalDouble.empty());
                } else {
                    assertThat(spot.score().getAsDouble()).isCloseTo(detection.score(), within(tolerance));
                    assertThat(spot.positionError().getAsDouble()).isCloseTo(detection.error(), within(tolerance));
                    spot.contrast().ifPresent(contrast -> assertThat(contrast).isEqualTo(detection.contrast()));
                }
            }
        }
        assertThat(interpolated).as("interpolated points in this world").isPositive();
    }

    private static void assertSamePlace(TrackPoint point, ImportedSpot spot, double tolerance) {
        assertThat(spot.frame()).isEqualTo(point.frame());
        assertThat(spot.x()).isCloseTo(point.box().centreX(), within(tolerance));
        assertThat(spot.y()).isCloseTo(point.box().centreY(), within(tolerance));
        assertThat(spot.interpolated()).isEqualTo(point.interpolated());
    }

    @Test
    void noTracksAreWrittenAndReadAsNone() throws IOException {
        TrackedFilm none = TrackedFilm.of(
                TrackedWorlds.of(1, true, Interpolation.FILL_GAPS).film(), List.of(), List.of());
        Path xml = folder.resolve("none.xml");
        Path csv = folder.resolve("none.csv");
        Path mdf = folder.resolve("none.mdf");

        TrackMateXml.write(xml, none);
        TrackCsv.write(csv, none);
        Mdf.write(mdf, none);

        assertThat(TrackMateXmlReader.read(xml).tracks()).isEmpty();
        assertThat(TrackCsvReader.read(csv).tracks()).isEmpty();
        assertThat(MdfReader.read(mdf).tracks()).isEmpty();
    }

    @Test
    void everyClassOfMotilityHasItsCluster() throws IOException {
        TrackedFilm tracked = TrackedWorlds.of(11, true, Interpolation.FILL_GAPS);
        Path file = folder.resolve("tracks.mdf");

        Mdf.write(file, tracked);

        int known = 0;
        while (tracked.motility().get(known).motilityClass().isEmpty()) {
            known++;
        }
        MotilityClass motilityClass =
                tracked.motility().get(known).motilityClass().orElseThrow();
        String name = "Cluster %d Track %d".formatted(motilityClass.ordinal() + 1, known + 1);
        assertThat(MdfReader.read(file).tracks())
                .extracting(ImportedTrack::name)
                .contains(name);
    }
}
