# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads TrackMate's XML: its model file (versions 2 to 8) and its "Export tracks to XML".

Positions there are in the film's units, pixel-centre = whole coordinate times the pixel's width or height; ours are in
pixels.
A track of TrackMate is a graph; where it splits or merges it is cut, and each unbranched part is a track of its own.
"""

from __future__ import annotations

import itertools
import math
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import parse as parse_xml

from memtrack.errors import InvalidInputError, SettingsError
from memtrack.film import Calibration
from memtrack.tracks import UNLINKED, Motility, TrackTable
from memtrack.units import micrometres, pixel_micrometres, seconds

_PIXEL_UNITS = ("pixel", "pixels", "px")


@dataclass(frozen=True, slots=True)
class _Spot:
    frame: int
    x: float
    y: float
    width: float
    height: float
    quality: float
    interpolated: bool
    ignored: bool


def read(path: Path, calibration: Calibration) -> TrackTable:
    """Read the visible spots and the tracks that pass TrackMate's track filter.

    Only spots that MEMTrack made have boxes: another detector's radius is a setting of it, not the size of what it saw.
    Spots without a track get the id UNLINKED.

    Raises:
        InvalidInputError: the file cannot be read, or is no XML of TrackMate.
        SettingsError: positions in micrometres, and no pixel size in the file nor in `calibration`.
        ValueError: an impossible value.
    """
    try:
        root = parse_xml(path, forbid_dtd=True).getroot()
    except OSError as error:
        raise InvalidInputError(f"cannot read {path}: {error.strerror}; check the path") from error
    except DefusedXmlException as error:
        raise InvalidInputError(f"{path} has a document type or entities, which TrackMate never writes") from error
    except (ElementTree.ParseError, LookupError) as error:
        raise InvalidInputError(f"{path} is not well-formed XML ({error}); export it from TrackMate again") from error
    if root.tag == "TrackMate":
        return _read_model(root, calibration)
    if root.tag == "Tracks":
        return _read_export(root, calibration)
    raise ValueError(f"the root element is <{root.tag}>, expected <TrackMate> or <Tracks>")


def _read_model(root: Element, calibration: Calibration) -> TrackTable:
    model = root.find("Model")
    if model is None:
        raise ValueError("no <Model> element; save the file in TrackMate after detection")
    image = root.find("Settings/ImageData")
    if image is not None:
        unit_size, interval = _number(image, "pixelwidth"), _number(image, "timeinterval")
        height = _number(image, "pixelheight", unit_size)
    else:
        unit_size, interval, height = math.nan, math.nan, math.nan
    scale, found = _scale(model.get("spatialunits", "pixel"), unit_size, calibration)
    down = height if height > 0 and unit_size > 0 else scale
    interval *= seconds(model.get("timeunits", "")) or 0
    spots = {}
    for spot in model.iterfind("AllSpots/SpotsInFrame/Spot"):
        if spot.get("VISIBILITY", "1") != "0":
            interpolated = _number(spot, "MEMTRACK_INTERPOLATED", 0.0) == 1.0
            spots[_whole(spot, "ID")] = _Spot(
                _whole(spot, "FRAME"),
                _number(spot, "POSITION_X") / scale,
                _number(spot, "POSITION_Y") / down,
                _number(spot, "MEMTRACK_BOX_WIDTH", math.nan) / scale,
                _number(spot, "MEMTRACK_BOX_HEIGHT", math.nan) / down,
                # An interpolated spot has the quality 0, which TrackMate wants of each, and no score.
                _number(spot, "MEMTRACK_SCORE", math.nan if interpolated else _number(spot, "QUALITY", math.nan)),
                interpolated,
                _number(spot, "MEMTRACK_IGNORED", 0.0) == 1.0,
            )
    kept = {track.get("TRACK_ID") for track in model.iterfind("FilteredTracks/TrackID")}
    edges: list[tuple[int, int]] = []
    motility_of: dict[int, Motility] = {}
    for track in model.iterfind("AllTracks/Track"):
        if track.get("TRACK_ID") in kept:
            links = [
                (_whole(edge, "SPOT_SOURCE_ID"), _whole(edge, "SPOT_TARGET_ID")) for edge in track.iterfind("Edge")
            ]
            edges += links
            if track.get("MEMTRACK_TRACK_MOTILITY") is not None:
                motility = Motility(_whole(track, "MEMTRACK_TRACK_MOTILITY"))
                motility_of |= dict.fromkeys((spot for link in links for spot in link), motility)
    track_of = _unbranched(spots, edges)
    rows = list(spots.values())
    return TrackTable.of(
        [spot.frame for spot in rows],
        [track_of.get(spot_id, UNLINKED) for spot_id in spots],
        [spot.x for spot in rows],
        [spot.y for spot in rows],
        width=[spot.width for spot in rows],
        height=[spot.height for spot in rows],
        scores=[spot.quality for spot in rows],
        interpolated=[spot.interpolated for spot in rows],
        ignored=[spot.ignored for spot in rows],
        motility=[motility_of.get(spot_id, Motility.UNKNOWN) for spot_id in spots],
        calibration=Calibration(found, interval if interval > 0 else None),
    )


def _unbranched(spots: dict[int, _Spot], edges: list[tuple[int, int]]) -> dict[int, int]:
    """Number the unbranched parts of the graph from 0: which track each linked spot belongs to."""
    after: dict[int, list[int]] = defaultdict(list)
    before: dict[int, list[int]] = defaultdict(list)
    for pair in edges:
        if all(spot in spots for spot in pair):
            source, target = sorted(pair, key=lambda spot: spots[spot].frame)
            if spots[source].frame == spots[target].frame:
                raise ValueError(f"spots {source} and {target} of frame {spots[source].frame} are linked")
            after[source].append(target)
            before[target].append(source)
    track_of: dict[int, int] = {}
    tracks = itertools.count()
    for spot in sorted(set(after) | set(before), key=lambda spot: (spots[spot].frame, spot)):
        goes_on = len(before[spot]) == 1 and len(after[before[spot][0]]) == 1
        track_of[spot] = track_of[before[spot][0]] if goes_on else next(tracks)
    return track_of


def _read_export(root: Element, calibration: Calibration) -> TrackTable:
    scale, found = _scale(root.get("spaceUnits", "pixel"), math.nan, calibration)
    interval = _number(root, "frameInterval", math.nan) * (seconds(root.get("timeUnits", "")) or 0)
    points = [
        (_whole(point, "t"), track, _number(point, "x") / scale, _number(point, "y") / scale)
        for track, particle in enumerate(root.iterfind("particle"))
        for point in particle.iterfind("detection")
    ]
    frames, ids, x, y = zip(*points, strict=True) if points else ((), (), (), ())
    return TrackTable.of(frames, ids, x, y, calibration=Calibration(found, interval if interval > 0 else None))


def _scale(unit: str, unit_size: float, calibration: Calibration) -> tuple[float, float | None]:
    """Units a pixel across, and the pixel's size in micrometres if it is known."""
    if unit.strip().lower() in _PIXEL_UNITS:
        return (unit_size if unit_size > 0 else 1.0), None
    in_micrometres = micrometres(unit)
    if unit_size > 0:
        return unit_size, pixel_micrometres(unit_size, unit)
    if calibration.pixel_size_um is not None and in_micrometres is not None:
        return calibration.pixel_size_um / in_micrometres, calibration.pixel_size_um
    raise SettingsError(
        f"the positions in the TrackMate file are in {unit!r} and it has no pixel size; give --pixel-size-um"
    )


def _number(element: Element, name: str, default: float | None = None) -> float:
    word = element.get(name)
    if word is None and default is not None:
        return default
    try:
        return float(word or "")
    except ValueError:
        raise ValueError(f"<{element.tag}> has {name}={word!r}, expected a number") from None


def _whole(element: Element, name: str) -> int:
    value = _number(element, name)
    if not math.isfinite(value) or value != round(value):
        raise ValueError(f"<{element.tag}> has {name}={element.get(name)!r}, expected a whole number")
    return round(value)
