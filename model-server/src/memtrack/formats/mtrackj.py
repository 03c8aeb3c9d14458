# SPDX-License-Identifier: GPL-3.0-or-later
"""MTrackJ's data files (.mdf), written from the behaviour of the format.

```
header ["Displaying" ...] ["Offset" ...] ["Reference" ...]
{"Assembly" n [RRGGBB] {"Cluster" n [RRGGBB] {"Track" n [RRGGBB [visible]] {"Point" n x y z t c}}}} [trailer]
```
x and y are in pixels; z, t and c count from 1, t may be written as a decimal number. Of several assemblies the last
counts, of several points of a track at one time the last counts. Track numbers start anew in each cluster.
"""

from __future__ import annotations

import colorsys
import math
from pathlib import Path

from memtrack.files import read_text, write_text
from memtrack.film import Calibration
from memtrack.tracks import TrackTable

_DISPLAYING = (
    "Displaying true true true 1 1 0 4 100 5 0 0 0 2 0 12 0 false false false false"
    # reference, active and finished tracks; visibility, colouring by track, colours; opacity, sizes, shapes, font; rest
)


def read(path: Path, calibration: Calibration) -> TrackTable:
    """Read tracks; they are numbered from 1 in the order of the file, clusters of tracks are not kept.

    Raises:
        InvalidInputError: the file cannot be read.
        ValueError: not an MTrackJ file, or a line that cannot be understood; the message has its number.
    """
    lines = read_text(path).splitlines()
    header = lines[0].split() if lines else []
    if header[:1] != ["MTrackJ"] or header[2:] != ["Data", "File"]:
        raise ValueError("the first line is not 'MTrackJ <version> Data File'")
    points: dict[tuple[int, int], tuple[float, float]] = {}
    track = 0
    for number, line in enumerate(lines[1:], start=2):
        word, *values = line.split() or [""]
        if word == "Assembly":
            points.clear()
            track = 0
        elif word == "Track":
            track += 1
        elif word == "Point":
            if track == 0:
                raise ValueError(f"line {number} has a point before any track")
            try:
                x, y, t = (float(values[i]) for i in (1, 2, 4))
                frame = round(t) - 1
            except (ValueError, IndexError, OverflowError):
                raise ValueError(f"line {number} is {line!r}, expected 'Point n x y z t c'") from None
            if not (math.isfinite(x) and math.isfinite(y)) or frame < 0:
                raise ValueError(f"line {number} is {line!r}: x and y must be finite, t at least 1")
            points[track, frame] = (x, y)
        elif line.startswith("End of MTrackJ"):
            break
        elif word not in ("", "Displaying", "Offset", "Reference", "Origin", "Cluster"):
            raise ValueError(f"line {number} starts with {word!r}, which MTrackJ files do not have")
    return TrackTable.of(
        [frame for _, frame in points],
        [track for track, _ in points],
        [x for x, _ in points.values()],
        [y for _, y in points.values()],
    )


def write(path: Path, table: TrackTable) -> None:
    """Write tracks as version 1.5.1, one cluster, a colour a track; detections without a track are left out.

    Raises:
        InvalidInputError: the file cannot be written.
    """
    lines = ["MTrackJ 1.5.1 Data File", _DISPLAYING, "Assembly 1 FF0000", "Cluster 1 FF0000"]
    for number, track in enumerate(table.tracks(), start=1):
        lines.append(f"Track {number} {_colour(number)} true")
        for i in range(len(track)):
            lines.append(f"Point {i + 1} {track.x[i]:.4f} {track.y[i]:.4f} 1.0 {track.frames[i] + 1}.0 1.0")
    write_text(path, "\r\n".join([*lines, "End of MTrackJ Data File", ""]))


def _colour(number: int) -> str:
    """A colour that differs from those of the tracks before (steps of the golden angle round the hue circle)."""
    rgb = colorsys.hsv_to_rgb(number * 0.618034 % 1.0, 0.8, 1.0)
    return "".join(f"{round(255 * channel):02X}" for channel in rgb)
