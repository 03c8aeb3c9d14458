// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.tests;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import javax.imageio.ImageIO;
import javax.xml.parsers.DocumentBuilderFactory;
import org.w3c.dom.Document;
import org.w3c.dom.Element;
import org.w3c.dom.NodeList;

/** The files of one run, read by nothing of ours, and held against each other. */
final class RunFiles {
    private final Path folder;
    private final String name;

    RunFiles(Path folder, String name) {
        this.folder = folder;
        this.name = name;
    }

    List<Map<String, String>> points() throws Exception {
        return new TrackTable(file(".csv")).rows();
    }

    List<Map<String, String>> tracks() throws Exception {
        return new TrackTable(file(".motility.csv")).rows();
    }

    String provenance() throws Exception {
        return Files.readString(file(".json"), StandardCharsets.UTF_8);
    }

    /** Every file is there, nothing else is, and all tell of the same tracks. */
    void checkThatAllAgree() throws Exception {
        try (Stream<Path> files = Files.list(folder)) {
            assertThat(files.map(Path::getFileName).map(Path::toString))
                    .contains(
                            name + ".xml",
                            name + ".csv",
                            name + ".motility.csv",
                            name + ".mdf",
                            name + ".png",
                            name + ".json")
                    .noneMatch(file -> file.endsWith(".part"));
        }
        List<Map<String, String>> points = points();
        Map<String, List<Map<String, String>>> pointsOfTrack =
                points.stream().collect(Collectors.groupingBy(point -> point.get("track")));
        assertThat(tracks()).extracting(track -> track.get("track")).hasSameElementsAs(pointsOfTrack.keySet());

        Document xml = DocumentBuilderFactory.newInstance()
                .newDocumentBuilder()
                .parse(file(".xml").toFile());
        List<Element> spots = elements(xml, "Spot");
        assertThat(spots).hasSameSizeAs(points);
        assertThat(spots.stream().map(spot -> spot.getAttribute("ID"))).doesNotHaveDuplicates();
        List<Element> tracks = elements(xml, "Track");
        assertThat(tracks).hasSize(pointsOfTrack.size());
        assertThat(elements(xml, "TrackID")).hasSize(pointsOfTrack.size());
        // A track without gaps has one link less than points; link by link the spots are those of one track.
        assertThat(elements(xml, "Edge")).hasSize(points.size() - pointsOfTrack.size());
        assertThat(tracks.stream().map(RunFiles::spotsOf).map(Set::size).sorted())
                .isEqualTo(
                        pointsOfTrack.values().stream().map(List::size).sorted().toList());
        assertThat(spots.stream()
                        .map(spot -> (int) Double.parseDouble(spot.getAttribute("FRAME")))
                        .sorted())
                .isEqualTo(points.stream()
                        .map(point -> Integer.parseInt(point.get("frame")))
                        .sorted()
                        .toList());

        List<String> mdf = Files.readAllLines(file(".mdf"), StandardCharsets.US_ASCII);
        assertThat(mdf.stream().filter(line -> line.startsWith("Point "))).hasSameSizeAs(points);
        assertThat(mdf.stream().filter(line -> line.startsWith("Track "))).hasSize(pointsOfTrack.size());

        assertThat(provenance())
                .contains("\"tracks\": " + pointsOfTrack.size())
                .contains("\"points\": " + points.size())
                .contains("\"interpolated_points\": "
                        + points.stream()
                                .filter(point -> point.get("interpolated").equals("1"))
                                .count());
        assertThat(ImageIO.read(file(".png").toFile()).getWidth()).isGreaterThan(500);
    }

    private Path file(String ending) {
        return folder.resolve(name + ending);
    }

    private static Set<String> spotsOf(Element track) {
        Set<String> ids = new TreeSet<>();
        for (Element edge : children(track.getElementsByTagName("Edge"))) {
            ids.add(edge.getAttribute("SPOT_SOURCE_ID"));
            ids.add(edge.getAttribute("SPOT_TARGET_ID"));
        }
        return ids;
    }

    private static List<Element> elements(Document document, String tag) {
        return children(document.getElementsByTagName(tag));
    }

    private static List<Element> children(NodeList nodes) {
        return IntStream.range(0, nodes.getLength())
                .mapToObj(i -> (Element) nodes.item(i))
                .toList();
    }
}
