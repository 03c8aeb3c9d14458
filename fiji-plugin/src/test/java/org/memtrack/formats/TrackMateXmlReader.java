// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.Set;
import java.util.stream.IntStream;
import javax.xml.parsers.DocumentBuilderFactory;
import javax.xml.parsers.ParserConfigurationException;
import org.memtrack.motility.MotilityClass;
import org.w3c.dom.Document;
import org.w3c.dom.Element;
import org.w3c.dom.NodeList;
import org.xml.sax.SAXException;

/** Reads what {@link TrackMateXml} writes; whether TrackMate itself does is tested with the real one. */
final class TrackMateXmlReader {
    private final Document xml;
    private final double pixelSize;

    private TrackMateXmlReader(Document xml) {
        this.xml = xml;
        this.pixelSize = number(only("ImageData"), "pixelwidth").orElseThrow();
    }

    /** @param source that names its film */
    static ImportedTracks read(Path source) throws IOException {
        try {
            return new TrackMateXmlReader(DocumentBuilderFactory.newInstance()
                            .newDocumentBuilder()
                            .parse(source.toFile()))
                    .read();
        } catch (ParserConfigurationException | SAXException e) {
            throw new IOException(e);
        }
    }

    private ImportedTracks read() {
        Map<Integer, ImportedSpot> spots = new LinkedHashMap<>();
        all(xml.getDocumentElement(), "Spot").forEach(spot -> spots.put(integer(spot, "ID"), spot(spot)));
        Element image = only("ImageData");
        Element model = only("Model");
        return new ImportedTracks(
                "TrackMate " + xml.getDocumentElement().getAttribute("version"),
                List.copyOf(spots.values()),
                all(xml.getDocumentElement(), "Track").stream()
                        .map(track -> track(track, spots))
                        .toList(),
                model.getAttribute("spatialunits").equals("pixel")
                        ? OptionalDouble.empty()
                        : OptionalDouble.of(pixelSize),
                model.getAttribute("timeunits").equals("frame")
                        ? OptionalDouble.empty()
                        : number(image, "timeinterval"),
                Optional.of(Path.of(image.getAttribute("folder"), image.getAttribute("filename"))));
    }

    private ImportedSpot spot(Element spot) {
        return new ImportedSpot(
                integer(spot, "ID"),
                integer(spot, "FRAME"),
                pixels(spot, "POSITION_X").orElseThrow(),
                pixels(spot, "POSITION_Y").orElseThrow(),
                pixels(spot, SpotFeature.BOX_WIDTH.key()),
                pixels(spot, SpotFeature.BOX_HEIGHT.key()),
                number(spot, SpotFeature.SCORE.key()),
                SpotFeature.levelOf(number(spot, SpotFeature.LEVEL.key()).orElse(0)),
                integer(spot, SpotFeature.INTERPOLATED.key()) == 1,
                number(spot, SpotFeature.CONTRAST.key()),
                pixels(spot, SpotFeature.POSITION_ERROR.key()),
                pixels(spot, SpotFeature.DRIFT_X.key()),
                pixels(spot, SpotFeature.DRIFT_Y.key()));
    }

    private static ImportedTrack track(Element track, Map<Integer, ImportedSpot> spots) {
        Set<ImportedSpot> linked = new LinkedHashSet<>();
        List<Double> costs = new ArrayList<>();
        for (Element edge : all(track, "Edge")) {
            linked.add(spots.get(integer(edge, "SPOT_SOURCE_ID")));
            linked.add(spots.get(integer(edge, "SPOT_TARGET_ID")));
            costs.add(number(edge, "LINK_COST").orElseThrow());
        }
        return new ImportedTrack(
                integer(track, "TRACK_ID"),
                track.getAttribute("name"),
                List.copyOf(linked),
                costs,
                number(track, TrackMateFeatures.MOTILITY).stream()
                        .mapToObj(code -> MotilityClass.values()[(int) code])
                        .findFirst());
    }

    private OptionalDouble pixels(Element element, String attribute) {
        return number(element, attribute).stream()
                .map(value -> value / pixelSize)
                .findFirst();
    }

    private static OptionalDouble number(Element element, String attribute) {
        return element.hasAttribute(attribute)
                ? OptionalDouble.of(Double.parseDouble(element.getAttribute(attribute)))
                : OptionalDouble.empty();
    }

    private static int integer(Element element, String attribute) {
        return Integer.parseInt(element.getAttribute(attribute));
    }

    private Element only(String name) {
        return all(xml.getDocumentElement(), name).get(0);
    }

    private static List<Element> all(Element parent, String name) {
        NodeList found = parent.getElementsByTagName(name);
        return IntStream.range(0, found.getLength())
                .mapToObj(i -> (Element) found.item(i))
                .toList();
    }
}
