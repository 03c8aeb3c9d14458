# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of detections: a CSV with one header row, or JSON with the provenance in the same file.

Columns of the CSV: frame (from 0), x_min, y_min, x_max, y_max (pixels of the film), score (0 to 1), level (low, medium,
high). The JSON is `{"provenance": {...}, "frame_count": n, "detections": [{"frame": 0, "x_min": ...}, ...]}`.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from memtrack.detections import Detections, FrameDetections, Level
from memtrack.errors import InvalidInputError
from memtrack.files import read_text, write_text

COLUMNS = ("frame", "x_min", "y_min", "x_max", "y_max", "score", "level")
SUFFIXES = (".csv", ".json")
_MAX_FRAME = 10_000_000


def write_detections(path: Path, frames: Sequence[FrameDetections], provenance: Mapping[str, Any]) -> list[Path]:
    """Writes `path` (.csv or .json), each file whole or not at all; returns the files written.

    Beside a CSV the provenance goes to `<name>.provenance.json`.

    Raises:
        InvalidInputError: another suffix, or the folder cannot be written to.
    """
    files = files_of(path)
    if path.suffix.lower() == ".json":
        document = {
            "provenance": dict(provenance),
            "frame_count": len(frames),
            "detections": [dict(zip(COLUMNS, row, strict=True)) for row in _rows(frames)],
        }
        write_text(path, json.dumps(document, indent=1, ensure_ascii=False) + "\n")
        return files
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows(_rows(frames))
    # First what cannot be made again without the detection.
    write_text(path, text.getvalue())
    write_text(files[1], json.dumps({**provenance, "frame_count": len(frames)}, indent=1, ensure_ascii=False) + "\n")
    return files


def read_detections(path: Path) -> list[FrameDetections]:
    """The detections in `path`, one entry a frame from 0; a CSV ends with the last frame that has a detection.

    Raises:
        InvalidInputError: the file cannot be read, or a row makes no sense.
    """
    text = read_text(path)
    if _suffix(path) == ".csv":
        table = csv.DictReader(io.StringIO(text))
        missing = set(COLUMNS) - set(table.fieldnames or ())
        if missing:
            raise InvalidInputError(
                f"{path.name} lacks the column(s) {', '.join(sorted(missing))}; its header must be {','.join(COLUMNS)}"
            )
        rows: Iterable[Mapping[str, Any]] = table
        count = 0
    else:
        try:
            document = json.loads(text)
            rows, count = list(document["detections"]), int(document["frame_count"])
        except (ValueError, TypeError, KeyError) as error:
            raise InvalidInputError(
                f"{path.name} is no file of detections ({error}); write it with memtrack detect"
            ) from error
    found: dict[int, list[tuple[float, ...]]] = {}
    for number, row in enumerate(rows, start=1):
        frame, values = _parse(row, f"{path.name}, detection {number}")
        found.setdefault(frame, []).append(values)
    count = max(count, max(found, default=-1) + 1)
    return [FrameDetections(frame, _detections(found.get(frame, []))) for frame in range(count)]


def files_of(path: Path) -> list[Path]:
    """The files that `write_detections` writes for `path`, itself first; InvalidInputError for another suffix."""
    beside = path.with_name(f"{path.stem}.provenance.json")
    return [path] if _suffix(path) == ".json" else [path, beside]


def _suffix(path: Path) -> str:
    if path.suffix.lower() not in SUFFIXES:
        raise InvalidInputError(f"{path.name} must end in {' or '.join(SUFFIXES)}")
    return path.suffix.lower()


def _rows(frames: Iterable[FrameDetections]) -> Iterable[tuple[Any, ...]]:
    for found in frames:
        d = found.detections
        for box, score, level in zip(d.boxes.tolist(), d.scores.tolist(), d.levels.tolist(), strict=True):
            yield (found.frame, *(round(edge, 3) for edge in box), round(score, 4), Level(level).name.lower())


def _parse(row: Mapping[str, Any], where: str) -> tuple[int, tuple[float, ...]]:
    try:
        frame = int(row["frame"])
        numbers = [float(row[name]) for name in COLUMNS[1:6]]
        level = Level[str(row["level"]).upper()]
    except (KeyError, ValueError, TypeError) as error:
        raise InvalidInputError(f"{where}: {error} makes no sense; see the columns {','.join(COLUMNS)}") from error
    x_min, y_min, x_max, y_max, score = numbers
    if not 0 <= frame <= _MAX_FRAME or not all(map(math.isfinite, numbers)):
        raise InvalidInputError(f"{where}: frame {frame} or one of {numbers} is out of range")
    if x_max < x_min or y_max < y_min or not 0 <= score <= 1:
        raise InvalidInputError(f"{where}: box {numbers[:4]} is inside out, or score {score} not in 0 to 1")
    return frame, (*numbers, float(level))


def _detections(rows: list[tuple[float, ...]]) -> Detections:
    table = np.array(rows, np.float64).reshape(-1, 6)
    return Detections(table[:, :4].astype(np.float32), table[:, 4].astype(np.float32), table[:, 5].astype(np.int8))
