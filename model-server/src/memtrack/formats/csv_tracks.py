# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracks in tables: ours, the authors' `Raw Data.csv`, truth tables, and the MOT challenge's text files.

Ours has one header row and a row a point, positions and boxes in pixels:
`track,frame,time_s,x,y,x_um,y_um,width,height,score,interpolated,ignored,motility`, as the plug-in writes it (which
has the column level in place of ignored). Columns are found by name, in any order; only track, frame, x and y must be
there. The calibration is read off the columns in seconds and micrometres. A truth table may say by `cls` (anything but
"bacterium") or `edge` (1) that a row is neither right nor wrong to find.
"""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path

import numpy as np
from jaxtyping import Float64

from memtrack.files import read_text, write_text
from memtrack.film import Calibration
from memtrack.tracks import UNLINKED, Motility, TrackTable

Column = Float64[np.ndarray, " n"]
HEADER = "track,frame,time_s,x,y,x_um,y_um,width,height,score,interpolated,ignored,motility"

# A table with several of these names has the first of them: its "id" beside a "track" is that of a spot.
_NAMES = {
    "track": ("track", "track_id", "tid", "particle", "id"),
    "frame": ("frame", "pid"),
    "x": ("x", "x_px", "x [pixel]"),
    "y": ("y", "y_px", "y [pixel]"),
    "time": ("time_s",),
    "x_um": ("x_um",),
    "width": ("width", "width_px"),
    "height": ("height", "height_px"),
    "score": ("score", "quality"),
    "interpolated": ("interpolated",),
    "ignored": ("ignored", "ignore"),
    "motility": ("motility", "subpopulation"),
    "class": ("cls",),
    "edge": ("edge",),
}


def read(path: Path, calibration: Calibration) -> TrackTable:
    """Read a table with a header row; commas, semicolons or tabs between the columns.

    `PID` counts from 1 (MTrackJ's table, where the authors use it as the frame), `frame` from 0. Empty cells, NA and
    nan are a value that is not known.

    Raises:
        InvalidInputError: the file cannot be read.
        ValueError: a column is missing, or a row has an impossible value; the message has its line.
    """
    text = read_text(path)
    header = text.partition("\n")[0]
    delimiter = max(",;\t", key=header.count)
    try:
        rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter))
    except csv.Error as error:
        raise ValueError(f"not a table ({error})") from error
    names = [name.strip().lower() for name in rows[0]] if rows else []
    best = {key: next((name for name in known if name in names), None) for key, known in _NAMES.items()}
    places = {key: names.index(name) for key, name in best.items() if name is not None}
    missing = [key for key in ("track", "frame", "x", "y") if key not in places]
    if missing:
        raise ValueError(
            f"no column for {', '.join(missing)} among {', '.join(names) or 'nothing'}; "
            "expected track, frame, x, y (or TID, PID, x [pixel], y [pixel])"
        )
    first_frame = 1 if names[places["frame"]] == "pid" else 0
    lines = [(number, row) for number, row in enumerate(rows[1:], start=2) if any(cell.strip() for cell in row)]

    def words(key: str) -> list[str]:
        return [row[places[key]].strip() if places[key] < len(row) else "" for _, row in lines]

    def numbers(key: str, *, whole: bool = False, required: bool = False) -> Column:
        values = np.full(len(lines), np.nan)
        for i, (line, word) in enumerate(zip((line for line, _ in lines), words(key), strict=True)):
            values[i] = _number(word, line, names[places[key]])
            if (required and not math.isfinite(values[i])) or (whole and values[i] != round(values[i])):
                raise ValueError(f"line {line} has {word!r} for {names[places[key]]}, expected a number")
        return values

    def optional(key: str) -> Column:
        return numbers(key) if key in places else np.full(len(lines), np.nan)

    ignored = (optional("ignored") == 1) | (optional("edge") == 1)
    if "class" in places:
        ignored |= np.array([word.lower() != "bacterium" for word in words("class")], np.bool_)
    frame, x = numbers("frame", whole=True, required=True) - first_frame, numbers("x", required=True)
    return TrackTable.of(
        frame,
        numbers("track", whole=True, required=True),
        x,
        numbers("y", required=True),
        width=optional("width"),
        height=optional("height"),
        scores=optional("score"),
        interpolated=optional("interpolated") == 1,
        ignored=ignored,
        motility=[Motility.parse(word) for word in words("motility")] if "motility" in places else Motility.UNKNOWN,
        calibration=Calibration(_factor(optional("x_um"), x), _factor(optional("time"), frame)),
    )


def _factor(calibrated: Column, plain: Column) -> float | None:
    """What one column is multiplied by to give the other, read where rounding counts least; None if unknown."""
    known = np.flatnonzero(np.isfinite(calibrated) & (plain != 0))
    if not len(known):
        return None
    row = known[np.abs(plain[known]).argmax()]
    factor = float(calibrated[row]) / float(plain[row])
    return factor if 0 < factor < math.inf else None


def _number(word: str, line: int, column: str) -> float:
    """A cell as a number; true and false are 1 and 0, an empty cell NaN."""
    if word.lower() in ("", "na", "nan", "none"):
        return math.nan
    if word.lower() in ("true", "false"):
        return float(word.lower() == "true")
    try:
        return float(word)
    except ValueError:
        raise ValueError(f"line {line} has {word!r} for {column}, expected a number") from None


def write(path: Path, table: TrackTable) -> None:
    """Write our table; numbers have four decimals, what is not known stays empty.

    Raises:
        InvalidInputError: the file cannot be written.
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(HEADER.split(","))
    pixel, interval = (table.calibration.pixel_size_um, table.calibration.frame_interval_seconds)
    pixel, interval = (math.nan if unit is None else unit for unit in (pixel, interval))
    for i in range(len(table)):
        frame, x, y = int(table.frames[i]), table.x[i], table.y[i]
        motility = Motility(int(table.motility[i]))
        writer.writerow(
            [
                int(table.ids[i]),
                frame,
                *map(_cell, (frame * interval, x, y, x * pixel, y * pixel)),
                *map(_cell, (table.width[i], table.height[i], table.scores[i])),
                int(table.interpolated[i]),
                int(table.ignored[i]),
                "" if motility is Motility.UNKNOWN else motility.name.lower(),
            ]
        )
    write_text(path, out.getvalue())


def _cell(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.4f}"


def read_mot(path: Path, calibration: Calibration) -> TrackTable:
    """Read `frame,id,left,top,width,height,score,...` without a header, frames from 1, id -1 for a detection.

    Raises:
        InvalidInputError: the file cannot be read.
        ValueError: a row has fewer than six numbers.
    """
    rows = []
    for line, text in enumerate(read_text(path).splitlines(), start=1):
        if text.strip():
            cells = [_number(cell.strip(), line, "a number") for cell in text.split(",")]
            if len(cells) < 6 or not np.isfinite(cells[:6]).all():
                raise ValueError(f"line {line} is {text!r}, expected frame,id,left,top,width,height[,score,...]")
            rows.append([*cells, math.nan][:7])
    columns = np.array(rows, np.float64).reshape(-1, 7).T
    frame, track, left, top, width, height, score = columns
    return TrackTable.of(
        frame - 1,
        np.maximum(track, UNLINKED),
        left + width / 2,
        top + height / 2,
        width=width,
        height=height,
        scores=score,
    )
