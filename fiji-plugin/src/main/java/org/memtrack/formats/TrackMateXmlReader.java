// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.BufferedInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.Set;
import org.memtrack.formats.ImportedTrack.Link;
import org.memtrack.motility.MotilityClass;

/** Reads one file of TrackMate as a stream, so that memory holds its spots and not its text. */
final class TrackMateXmlReader {
    private final XmlElements xml;
    private String version = "";
    private String spaceUnit = "pixel";
    private String timeUnit = "frame";
    private double pixelWidth = 1;
    private double pixelHeight = 1;
    private boolean hasImageData;
    private OptionalDouble interval = OptionalDouble.empty();
    private Optional<Path> image = Optional.empty();
    private int frame;
    private final Map<Integer, ImportedSpot> spots = new LinkedHashMap<>();
    private final List<RawTrack> tracks = new ArrayList<>();
    private final Set<Integer> visibleTracks = new HashSet<>();

    /** A track whose spots are not looked up yet. */
    private record RawTrack(int id, String name, Optional<MotilityClass> motility, List<Link> links) {}

    private TrackMateXmlReader(XmlElements xml) {
        this.xml = xml;
    }

    static ImportedTracks read(Path source) throws IOException {
        try (InputStream in = new BufferedInputStream(Files.newInputStream(source))) {
            XmlElements xml = new XmlElements(source, in);
            if (!xml.next()) {
                throw xml.wrong("is empty");
            }
            return switch (xml.name()) {
                case "TrackMate" -> new TrackMateXmlReader(xml).readModel();
                case "Tracks" -> SimpleTracksReader.read(xml);
                default -> throw xml.wrong("begins with <%s>, not <TrackMate> or <Tracks>".formatted(xml.name()));
            };
        }
    }

    private ImportedTracks readModel() throws FormatException {
        version = "TrackMate " + xml.text("version").orElse("of unknown version");
        boolean hasModel = false;
        while (xml.next()) {
            switch (xml.name()) {
                case "Model" -> {
                    hasModel = true;
                    spaceUnit = xml.text("spatialunits").orElse(spaceUnit);
                    timeUnit = xml.text("timeunits").orElse(timeUnit);
                }
                case "SpotsInFrame" -> frame = xml.requiredInteger("frame");
                case "Spot" -> readSpot();
                case "Track" ->
                    tracks.add(new RawTrack(
                            xml.requiredInteger("TRACK_ID"),
                            xml.text("name").orElse(""),
                            motility(),
                            new ArrayList<>()));
                case "Edge" -> readEdge();
                case "TrackID" -> visibleTracks.add(xml.requiredInteger("TRACK_ID"));
                case "ImageData" -> readImageData();
                default -> {} // log, feature declarations, settings of the run, display
            }
        }
        if (!hasModel) {
            throw xml.wrong("has no <Model>; it is from before TrackMate 2");
        }
        return finish();
    }

    private void readSpot() throws FormatException {
        double radius = xml.number("RADIUS").orElse(Double.NaN);
        int id = xml.requiredInteger("ID");
        OptionalDouble quality = xml.number("QUALITY");
        OptionalDouble score = xml.number(SpotFeature.SCORE.key());
        boolean interpolated = xml.number(SpotFeature.INTERPOLATED.key()).orElse(0) == 1;
        ImportedSpot spot = new ImportedSpot(
                id,
                frame,
                xml.requiredNumber("POSITION_X"),
                xml.requiredNumber("POSITION_Y"),
                size(SpotFeature.BOX_WIDTH, radius),
                size(SpotFeature.BOX_HEIGHT, radius),
                interpolated || score.isPresent() ? score : quality,
                SpotFeature.levelOf(xml.number(SpotFeature.LEVEL.key()).orElse(0)),
                interpolated,
                xml.number("VISIBILITY").orElse(1) != 0);
        if (frame < 0 || spots.put(id, spot) != null) {
            throw xml.wrong("has the spot %d twice or in a negative frame".formatted(id));
        }
    }

    private Optional<MotilityClass> motility() throws FormatException {
        double code = xml.number(TrackMateFeatures.MOTILITY).orElse(-1);
        return Arrays.stream(MotilityClass.values())
                .filter(motilityClass -> motilityClass.ordinal() == code)
                .findFirst();
    }

    private OptionalDouble size(SpotFeature feature, double radius) throws FormatException {
        OptionalDouble size = xml.number(feature.key());
        return size.isPresent() || Double.isNaN(radius) ? size : OptionalDouble.of(2 * radius);
    }

    private void readEdge() throws FormatException {
        int source = xml.requiredInteger("SPOT_SOURCE_ID");
        int target = xml.requiredInteger("SPOT_TARGET_ID");
        ImportedSpot sourceSpot = spots.get(source);
        ImportedSpot targetSpot = spots.get(target);
        if (tracks.isEmpty() || sourceSpot == null || targetSpot == null) {
            throw xml.wrong("links the spots %d and %d, which it does not have".formatted(source, target));
        }
        // TrackMate's graphs have no direction; ours point forward in time.
        boolean backward = sourceSpot.frame() > targetSpot.frame();
        double cost = xml.number("LINK_COST").orElse(Double.NaN);
        tracks.get(tracks.size() - 1)
                .links()
                .add(backward ? new Link(target, source, cost) : new Link(source, target, cost));
    }

    private void readImageData() throws FormatException {
        hasImageData = true;
        pixelWidth = xml.number("pixelwidth").orElse(1);
        pixelHeight = xml.number("pixelheight").orElse(pixelWidth);
        interval = xml.number("timeinterval");
        if (!(pixelWidth > 0 && pixelHeight > 0)) {
            throw xml.wrong("says that pixels are %s x %s large".formatted(pixelWidth, pixelHeight));
        }
        String name = xml.text("filename").orElse("");
        try {
            image = name.isEmpty()
                    ? Optional.empty()
                    : Optional.of(Path.of(xml.text("folder").orElse(""), name));
        } catch (InvalidPathException fromAnotherSystem) {
            image = Optional.empty();
        }
    }

    private ImportedTracks finish() {
        spots.replaceAll((id, spot) -> inPixels(spot));
        List<ImportedTrack> imported = tracks.stream().map(this::withSpots).toList();
        OptionalDouble unit = Units.micrometres(spaceUnit);
        OptionalDouble timeStep = Units.seconds(timeUnit);
        return new ImportedTracks(
                version,
                List.copyOf(spots.values()),
                imported,
                hasImageData && unit.isPresent()
                        ? OptionalDouble.of(pixelWidth * unit.getAsDouble())
                        : OptionalDouble.empty(),
                interval.isPresent() && interval.getAsDouble() > 0 && timeStep.isPresent()
                        ? OptionalDouble.of(interval.getAsDouble() * timeStep.getAsDouble())
                        : OptionalDouble.empty(),
                image);
    }

    private ImportedSpot inPixels(ImportedSpot spot) {
        return new ImportedSpot(
                spot.id(),
                spot.frame(),
                spot.x() / pixelWidth,
                spot.y() / pixelHeight,
                spot.width().stream().map(width -> width / pixelWidth).findFirst(),
                spot.height().stream().map(height -> height / pixelHeight).findFirst(),
                spot.score(),
                spot.level(),
                spot.interpolated(),
                spot.visible());
    }

    private ImportedTrack withSpots(RawTrack track) {
        Set<Integer> ids = new LinkedHashSet<>();
        for (Link link : track.links()) {
            ids.add(link.sourceId());
            ids.add(link.targetId());
        }
        List<ImportedSpot> ofTrack = ids.stream()
                .map(spots::get)
                .sorted(Comparator.comparingInt(ImportedSpot::frame))
                .toList();
        return new ImportedTrack(
                track.id(), track.name(), ofTrack, track.links(), visibleTracks.contains(track.id()), track.motility());
    }
}
