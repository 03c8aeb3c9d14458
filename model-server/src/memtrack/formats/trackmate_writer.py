# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes TrackMate's model file, as TrackMate 7 and 8 open it and the plug-in writes it; with a film it opens on that.

What only the plug-in knows is left out: levels, contrasts, errors, the stage's drift, speeds and diffusivities. A
truth says besides which spots are ignored.
"""

from __future__ import annotations

import itertools
import math
import os
from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np

from memtrack.boxes import pairwise_iou
from memtrack.files import write_text
from memtrack.tracks import Motility, TrackTable

_VERSION = "7.14.0"
"""Of the format; TrackMate 7 and 8 read it."""
_BOX_PX = 30.0
"""Edge of the box of a row that has none, as MTrackJ's points: that of the paper's detector."""

_SPOT_FEATURES = {
    "QUALITY": ("Quality", "Quality", "QUALITY", False),
    "POSITION_X": ("X", "X", "POSITION", False),
    "POSITION_Y": ("Y", "Y", "POSITION", False),
    "POSITION_Z": ("Z", "Z", "POSITION", False),
    "POSITION_T": ("T", "T", "TIME", False),
    "FRAME": ("Frame", "Frame", "NONE", True),
    "RADIUS": ("Radius", "R", "LENGTH", False),
    "VISIBILITY": ("Visibility", "Visibility", "NONE", True),
    "MEMTRACK_INTERPOLATED": ("Interpolated", "Interpol.", "NONE", True),
    "MEMTRACK_BOX_WIDTH": ("Box width", "Box width", "LENGTH", False),
    "MEMTRACK_BOX_HEIGHT": ("Box height", "Box height", "LENGTH", False),
    "MEMTRACK_SCORE": ("Detection score", "Score", "QUALITY", False),
    "MEMTRACK_MOTILITY": ("Motility class", "Motility", "NONE", True),
}
_TRUTH_FEATURES = {"MEMTRACK_IGNORED": ("Ignored", "Ignored", "NONE", True)}
"""Of spots, where one of them is ignored."""
_EDGE_FEATURES = {
    "SPOT_SOURCE_ID": ("Source spot ID", "Source ID", "NONE", True),
    "SPOT_TARGET_ID": ("Target spot ID", "Target ID", "NONE", True),
    "LINK_COST": ("Edge cost", "Cost", "COST", False),
}
_TRACK_FEATURES = {
    "TRACK_INDEX": ("Track index", "Index", "NONE", True),
    "TRACK_ID": ("Track ID", "ID", "NONE", True),
    "NUMBER_SPOTS": ("Number of spots in track", "N spots", "NONE", True),
    "TRACK_DURATION": ("Track duration", "Duration", "TIME", False),
    "TRACK_START": ("Track start", "Track start", "TIME", False),
    "TRACK_STOP": ("Track stop", "Track stop", "TIME", False),
    "MEMTRACK_TRACK_MOTILITY": ("Motility class (0 none, 1 low, 2 medium, 3 high)", "Motility", "NONE", True),
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

    The cost of a link is one minus the intersection over union of its two boxes.

    Raises:
        InvalidInputError: the file cannot be written.
    """
    pixel = table.calibration.pixel_size_um or 1.0
    interval = table.calibration.frame_interval_seconds or 1.0
    root = Element("TrackMate", version=_VERSION)
    SubElement(root, "Log").text = f"Written by MEMTrack: {len(table.track_ids)} tracks."
    model = SubElement(
        root,
        "Model",
        spatialunits="micron" if table.calibration.pixel_size_um else "pixel",
        timeunits="sec" if table.calibration.frame_interval_seconds else "frame",
    )
    declarations = SubElement(model, "FeatureDeclarations")
    _declare(
        SubElement(declarations, "SpotFeatures"), _SPOT_FEATURES | (_TRUTH_FEATURES if table.ignored.any() else {})
    )
    _declare(SubElement(declarations, "EdgeFeatures"), _EDGE_FEATURES)
    _declare(SubElement(declarations, "TrackFeatures"), _TRACK_FEATURES)
    _append_spots(model, table, pixel, interval)
    _append_tracks(model, table, interval)
    _append_settings(root, film or _blank(table), pixel, interval)
    SubElement(root, "GUIState", state="ConfigureViews")
    # Empty means the user's own; without it TrackMate tells of errors in the file.
    SubElement(root, "DisplaySettings")
    indent(root)
    write_text(path, '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n")


def _blank(table: TrackTable) -> FilmFile:
    """An image just large enough for every point; TrackMate needs one to know the pixel size."""
    width, height = (int(np.ceil(axis.max(initial=0))) + 1 for axis in (table.x, table.y))
    return FilmFile(None, width, height, max(table.frame_count, 1))


def _declare(parent: Element, features: dict[str, tuple[str, str, str, bool]]) -> None:
    for key, (name, short, dimension, whole) in features.items():
        SubElement(
            parent, "Feature", feature=key, name=name, shortname=short, dimension=dimension, isint=str(whole).lower()
        )


def _append_spots(model: Element, table: TrackTable, pixel: float, interval: float) -> None:
    """Spots are numbered by their row in the table."""
    spots = SubElement(model, "AllSpots", nspots=str(len(table)))
    boxed = table.with_boxes(_BOX_PX)
    marked = bool(table.ignored.any())
    for frame in np.unique(table.frames):
        in_frame = SubElement(spots, "SpotsInFrame", frame=str(frame))
        for row in np.flatnonzero(table.frames == frame):
            score, motility = float(table.scores[row]), int(table.motility[row])
            spot = SubElement(
                in_frame,
                "Spot",
                ID=str(row),
                name=f"ID{row}",
                QUALITY=repr(0.0 if math.isnan(score) else score),
                POSITION_X=repr(float(table.x[row]) * pixel),
                POSITION_Y=repr(float(table.y[row]) * pixel),
                POSITION_Z="0.0",
                POSITION_T=repr(int(frame) * interval),
                FRAME=str(frame),
                RADIUS=repr(float(boxed.width[row] + boxed.height[row]) / 4 * pixel),
                VISIBILITY="1",
                MEMTRACK_INTERPOLATED=str(int(table.interpolated[row])),
            )
            if marked:
                spot.set("MEMTRACK_IGNORED", str(int(table.ignored[row])))
            if not math.isnan(table.width[row] + table.height[row]):
                spot.set("MEMTRACK_BOX_WIDTH", repr(float(table.width[row]) * pixel))
                spot.set("MEMTRACK_BOX_HEIGHT", repr(float(table.height[row]) * pixel))
            if not math.isnan(score):
                spot.set("MEMTRACK_SCORE", repr(score))
            if motility != Motility.UNKNOWN:
                spot.set("MEMTRACK_MOTILITY", str(motility))


def _append_tracks(model: Element, table: TrackTable, interval: float) -> None:
    """A track of one point has no link, so TrackMate cannot hold it as a track: its spot stays without one."""
    tracks = SubElement(model, "AllTracks")
    filtered = SubElement(model, "FilteredTracks")
    boxes = table.with_boxes(_BOX_PX).boxes
    for index, track_id in enumerate(i for i in table.track_ids if (table.ids == i).sum() > 1):
        rows = np.flatnonzero(table.ids == track_id)
        first, last = int(table.frames[rows[0]]), int(table.frames[rows[-1]])
        track = SubElement(
            tracks,
            "Track",
            name=f"Track_{track_id}",
            TRACK_ID=str(track_id),
            TRACK_INDEX=str(index),
            NUMBER_SPOTS=str(len(rows)),
            TRACK_DURATION=repr((last - first) * interval),
            TRACK_START=repr(first * interval),
            TRACK_STOP=repr(last * interval),
        )
        if (motility := table.motility[rows].max()) != Motility.UNKNOWN:
            track.set("MEMTRACK_TRACK_MOTILITY", str(motility))
        for source, target in itertools.pairwise(rows):
            cost = 1 - float(pairwise_iou(boxes[[source]], boxes[[target]])[0, 0])
            SubElement(track, "Edge", SPOT_SOURCE_ID=str(source), SPOT_TARGET_ID=str(target), LINK_COST=repr(cost))
        SubElement(filtered, "TrackID", TRACK_ID=str(track_id))


def _append_settings(root: Element, film: FilmFile, pixel: float, interval: float) -> None:
    settings = SubElement(root, "Settings")
    SubElement(
        settings,
        "ImageData",
        filename=film.path.name if film.path else "",
        folder=os.path.join(film.path.resolve().parent, "") if film.path else "",
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
    SubElement(settings, "DetectorSettings", DETECTOR_NAME="MANUAL_DETECTOR", RADIUS=repr(_BOX_PX / 2 * pixel))
    SubElement(settings, "InitialSpotFilter", feature="QUALITY", value="0.0", isabove="true")
    SubElement(settings, "SpotFilterCollection")
    SubElement(settings, "TrackerSettings", TRACKER_NAME="MANUAL_TRACKER")
    SubElement(settings, "TrackFilterCollection")
    analyzers = SubElement(settings, "AnalyzerCollection")
    for kind in ("SpotAnalyzers", "EdgeAnalyzers", "TrackAnalyzers"):
        SubElement(analyzers, kind)
