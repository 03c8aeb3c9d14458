# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes TrackMate's model file, as TrackMate 7 and 8 open it; with a film it opens on that film."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np

from memtrack.files import write_text
from memtrack.tracks import UNLINKED, Motility, TrackTable

_DEFAULT_RADIUS = 5.0
"""Radius in pixels of a spot whose row has no box; MTrackJ points and truth tables have none."""

_SPOT_FEATURES = {
    "QUALITY": ("Quality", "QUALITY", False),
    "POSITION_X": ("X", "POSITION", False),
    "POSITION_Y": ("Y", "POSITION", False),
    "POSITION_Z": ("Z", "POSITION", False),
    "POSITION_T": ("T", "TIME", False),
    "FRAME": ("Frame", "NONE", True),
    "RADIUS": ("Radius", "LENGTH", False),
    "VISIBILITY": ("Visibility", "NONE", True),
    "MEMTRACK_BOX_WIDTH": ("MEMTrack box width", "LENGTH", False),
    "MEMTRACK_BOX_HEIGHT": ("MEMTrack box height", "LENGTH", False),
    "MEMTRACK_INTERPOLATED": ("MEMTrack interpolated", "NONE", True),
}
_EDGE_FEATURES = {
    "SPOT_SOURCE_ID": ("Source spot ID", "NONE", True),
    "SPOT_TARGET_ID": ("Target spot ID", "NONE", True),
    "LINK_COST": ("Edge cost", "COST", False),
}
_TRACK_FEATURES = {
    "TRACK_INDEX": ("Track index", "NONE", True),
    "TRACK_ID": ("Track ID", "NONE", True),
    "NUMBER_SPOTS": ("Number of spots in track", "NONE", True),
    "MEMTRACK_TRACK_MOTILITY": ("Motility class (0 none, 1 low, 2 medium, 3 high)", "NONE", True),
}


@dataclass(frozen=True, slots=True)
class FilmFile:
    """The film a model file opens on: where it is (None: TrackMate opens over a blank image), and its shape."""

    path: Path | None
    width: int
    height: int
    frame_count: int


def write(path: Path, table: TrackTable, film: FilmFile | None = None) -> None:
    """Write spots, tracks and units: micron and sec where the table's calibration is known, pixel and frame if not.

    Raises:
        InvalidInputError: the file cannot be written.
    """
    pixel = table.calibration.pixel_size_um or 1.0
    interval = table.calibration.frame_interval_seconds or 1.0
    root = Element("TrackMate", version="8.0.0")
    model = SubElement(
        root,
        "Model",
        spatialunits="micron" if table.calibration.pixel_size_um else "pixel",
        timeunits="sec" if table.calibration.frame_interval_seconds else "frame",
    )
    declarations = SubElement(model, "FeatureDeclarations")
    _declare(SubElement(declarations, "SpotFeatures"), _SPOT_FEATURES)
    _declare(SubElement(declarations, "EdgeFeatures"), _EDGE_FEATURES)
    _declare(SubElement(declarations, "TrackFeatures"), _TRACK_FEATURES)
    _append_spots(model, table, pixel, interval)
    _append_tracks(model, table)
    _append_settings(root, film or _blank(table), pixel, interval)
    indent(root)
    write_text(path, '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n")


def _blank(table: TrackTable) -> FilmFile:
    """An image just large enough for every point; TrackMate needs one to know the pixel size."""
    width, height = (int(np.ceil(axis.max(initial=0))) + 1 for axis in (table.x, table.y))
    return FilmFile(None, width, height, max(table.frame_count, 1))


def _declare(parent: Element, features: dict[str, tuple[str, str, bool]]) -> None:
    for key, (name, dimension, whole) in features.items():
        SubElement(
            parent, "Feature", feature=key, name=name, shortname=name, dimension=dimension, isint=str(whole).lower()
        )


def _append_spots(model: Element, table: TrackTable, pixel: float, interval: float) -> None:
    """Spots are numbered by their row in the table."""
    spots = SubElement(model, "AllSpots", nspots=str(len(table)))
    for frame in np.unique(table.frames):
        in_frame = SubElement(spots, "SpotsInFrame", frame=str(frame))
        for row in np.flatnonzero(table.frames == frame):
            width, height = float(table.width[row]), float(table.height[row])
            known = not math.isnan(width + height)
            spot = SubElement(
                in_frame,
                "Spot",
                ID=str(row),
                name=f"ID{row}",
                QUALITY=repr(0.0 if math.isnan(table.scores[row]) else float(table.scores[row])),
                POSITION_X=repr(float(table.x[row]) * pixel),
                POSITION_Y=repr(float(table.y[row]) * pixel),
                POSITION_Z="0.0",
                POSITION_T=repr(int(frame) * interval),
                FRAME=str(frame),
                RADIUS=repr(((width + height) / 4 if known else _DEFAULT_RADIUS) * pixel),
                VISIBILITY="1",
                MEMTRACK_INTERPOLATED=str(int(table.interpolated[row])),
            )
            if known:
                spot.set("MEMTRACK_BOX_WIDTH", repr(width * pixel))
                spot.set("MEMTRACK_BOX_HEIGHT", repr(height * pixel))


def _append_tracks(model: Element, table: TrackTable) -> None:
    """A track of one point has no link, so TrackMate cannot hold it as a track: its spot stays without one."""
    tracks = SubElement(model, "AllTracks")
    filtered = SubElement(model, "FilteredTracks")
    for index, track_id in enumerate(i for i in table.track_ids if i != UNLINKED and (table.ids == i).sum() > 1):
        rows = np.flatnonzero(table.ids == track_id)
        track = SubElement(
            tracks,
            "Track",
            name=f"Track_{track_id}",
            TRACK_INDEX=str(index),
            TRACK_ID=str(track_id),
            NUMBER_SPOTS=str(len(rows)),
        )
        if (motility := table.motility[rows].max()) != Motility.UNKNOWN:
            track.set("MEMTRACK_TRACK_MOTILITY", str(motility))
        for source, target in itertools.pairwise(rows):
            SubElement(track, "Edge", SPOT_SOURCE_ID=str(source), SPOT_TARGET_ID=str(target), LINK_COST="0.0")
        SubElement(filtered, "TrackID", TRACK_ID=str(track_id))


def _append_settings(root: Element, film: FilmFile, pixel: float, interval: float) -> None:
    settings = SubElement(root, "Settings")
    SubElement(
        settings,
        "ImageData",
        filename=film.path.name if film.path else "",
        folder=str(film.path.resolve().parent) if film.path else "",
        width=str(film.width),
        height=str(film.height),
        nslices="1",
        nframes=str(film.frame_count),
        pixelwidth=repr(pixel),
        pixelheight=repr(pixel),
        voxeldepth="1.0",
        timeinterval=repr(interval),
    )
    last = {"xend": film.width - 1, "yend": film.height - 1, "zend": 0, "tend": film.frame_count - 1}
    bounds = {"xstart": 0, "ystart": 0, "zstart": 0, "tstart": 0, **last}
    SubElement(settings, "BasicSettings", {key: str(value) for key, value in bounds.items()})
    SubElement(settings, "DetectorSettings", DETECTOR_NAME="MANUAL_DETECTOR", RADIUS=repr(_DEFAULT_RADIUS * pixel))
    SubElement(settings, "InitialSpotFilter", feature="QUALITY", value="0.0", isabove="true")
    SubElement(settings, "SpotFilterCollection")
    SubElement(settings, "TrackerSettings", TRACKER_NAME="MANUAL_TRACKER")
    SubElement(settings, "TrackFilterCollection")
    analyzers = SubElement(settings, "AnalyzerCollection")
    for kind in ("SpotAnalyzers", "EdgeAnalyzers", "TrackAnalyzers"):
        SubElement(analyzers, kind)
