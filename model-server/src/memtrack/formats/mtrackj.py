# SPDX-License-Identifier: GPL-3.0-or-later
"""MTrackJ's data files (.mdf), written from the behaviour of the format.

```
header ["Displaying" ...] ["Offset" ...] ["Reference" ...]
{"Assembly" n [RRGGBB] {"Cluster" n [RRGGBB] {"Track" n [RRGGBB [visible]] {"Point" n x y z t c}}}} [trailer]
```
x and y are in pixels; z, t and c count from 1, t is rounded to a whole number. Of several assemblies the last counts,
of several points of a track at one time the last counts. Track numbers start anew in each cluster. The format has no
place for a mark on a point, so MEMTrack writes an interpolated one with a time a quarter of a frame too late.
"""

from __future__ import annotations

import math
from collections import defaultdict
from pathlib import Path

from memtrack.files import read_text, write_text
from memtrack.film import Calibration
from memtrack.tracks import Motility, TrackTable

_INTERPOLATED = 0.25
"""Added to the time of an interpolated point, frames."""
_COLOURS = {
    Motility.NONE: "999999",
    Motility.LOW: "56B4E9",
    Motility.MEDIUM: "E69F00",
    Motility.HIGH: "D55E00",
    Motility.UNKNOWN: "009E73",
}
"""Of a cluster for each class, in this order; people with any colour vision can tell them apart (Okabe and Ito)."""


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
    points: dict[tuple[int, int], tuple[float, float, bool]] = {}
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
                frame = math.floor(t + 0.5) - 1
            except (ValueError, IndexError, OverflowError):
                raise ValueError(f"line {number} is {line!r}, expected 'Point n x y z t c'") from None
            if not (math.isfinite(x) and math.isfinite(y)) or frame < 0:
                raise ValueError(f"line {number} is {line!r}: x and y must be finite, t at least 1")
            points[track, frame] = (x, y, t - (frame + 1) == _INTERPOLATED)
        elif line.startswith("End of MTrackJ"):
            break
        elif word not in ("", "Displaying", "Offset", "Reference", "Origin", "Cluster"):
            raise ValueError(f"line {number} starts with {word!r}, which MTrackJ files do not have")
    return TrackTable.of(
        [frame for _, frame in points],
        [track for track, _ in points],
        [x for x, _, _ in points.values()],
        [y for _, y, _ in points.values()],
        interpolated=[interpolated for _, _, interpolated in points.values()],
    )


def write(path: Path, table: TrackTable) -> None:
    """Write tracks as version 1.5.1, as the plug-in does: a cluster and a colour for each class of motility.

    A track's number is its id, counted from 1; detections without a track are left out, and ignored rows of a truth,
    which the format cannot mark.

    Raises:
        InvalidInputError: the file cannot be written.
    """
    clusters: dict[Motility, list[TrackTable]] = defaultdict(list)
    for track in table.select(~table.ignored).tracks():
        clusters[Motility(int(track.motility.max()))].append(track)
    lines = ["MTrackJ 1.5.1 Data File", "Assembly 1 FF0000"]
    for number, (motility, colour) in enumerate(_COLOURS.items(), start=1):
        if motility in clusters:
            lines.append(f"Cluster {number} {colour}")
        for track in clusters[motility]:
            lines.append(f"Track {track.ids[0] + 1} {colour} true")
            for i in range(len(track)):
                time = track.frames[i] + 1 + _INTERPOLATED * track.interpolated[i]
                lines.append(f"Point {i + 1} {track.x[i]:.4f} {track.y[i]:.4f} 1.0 {float(time)} 1.0")
    write_text(path, "\r\n".join([*lines, "End of MTrackJ Data File", ""]))
