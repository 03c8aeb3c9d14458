# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of the films of one evaluation, and the CSV that lists them."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from memtrack.detections_io import read_detections
from memtrack.errors import InvalidInputError
from memtrack.evaluation.evaluate import FilmData
from memtrack.files import read_text
from memtrack.film import Calibration
from memtrack.tracks import UNCALIBRATED
from memtrack.tracks_io import read_tracks

COLUMNS = ("film", "truth", "tracks", "detections", "video", "pixel_size_um", "frame_interval_s")


@dataclass(frozen=True, slots=True)
class FilmFiles:
    """Where one film's truth is, what was found in it, and the film itself; the calibration the user states."""

    name: str
    truth: Path
    tracks: Path | None = None
    detections: Path | None = None
    video: Path | None = None
    calibration: Calibration = UNCALIBRATED

    def read(self) -> FilmData:
        """Everything but the film itself; what the user states of the calibration goes before what the files say.

        Raises:
            InvalidInputError: a file cannot be read.
        """
        truth = read_tracks(self.truth, self.calibration)
        tracks = None if self.tracks is None else read_tracks(self.tracks, self.calibration)
        known = [truth.calibration] + ([] if tracks is None else [tracks.calibration])
        return FilmData(
            self.name,
            truth,
            tracks,
            None if self.detections is None else read_detections(self.detections),
            Calibration(
                next((c.pixel_size_um for c in known if c.pixel_size_um), None),
                next((c.frame_interval_seconds for c in known if c.frame_interval_seconds), None),
            ),
        )


def read_list(path: Path, general: Calibration) -> list[FilmFiles]:
    """The films of a CSV with the header COLUMNS, of which only film (a name) and truth must be there.

    Paths start at the folder of the list; an empty calibration cell takes the `general` value.

    Raises:
        InvalidInputError: the file cannot be read, or a row cannot be used; the message has its line.
    """
    reader = csv.DictReader(io.StringIO(read_text(path)))
    unknown = set(reader.fieldnames or []) - set(COLUMNS)
    missing = {"film", "truth"} - set(reader.fieldnames or [])
    if unknown or missing:
        wrong = f"has no column {min(missing)}" if missing else f"has the unknown column {min(unknown)}"
        raise InvalidInputError(f"{path} {wrong}; expected {', '.join(COLUMNS)}")
    films = list(_films(reader, path, general))
    if not films:
        raise InvalidInputError(f"{path} lists no film; add a row for each")
    check_alike(films)
    return films


def check_alike(films: Sequence[FilmFiles]) -> None:
    """Either all films have tracks or none has, and the same for detections, so that their sums mean something.

    Raises:
        InvalidInputError: some have and some have not.
    """
    for what in ("tracks", "detections"):
        without = [film.name for film in films if getattr(film, what) is None]
        if without and len(without) < len(films):
            raise InvalidInputError(
                f"film {without[0]} has no {what} while others have; give {what} for all films or none"
            )


def _films(reader: csv.DictReader[str], path: Path, general: Calibration) -> Iterator[FilmFiles]:
    names = set()
    for line, row in enumerate(reader, start=2):
        if None in row or None in row.values() or not row["film"] or not row["truth"] or row["film"] in names:
            raise InvalidInputError(f"line {line} of {path} has no film, no truth, a film named before, or extra cells")
        names.add(row["film"])
        pixel, interval = (_size(row.get(column), line, path) for column in COLUMNS[-2:])
        files = (path.parent / row[what] if row.get(what) else None for what in ("tracks", "detections", "video"))
        tracks, detections, video = files
        calibration = Calibration(pixel or general.pixel_size_um, interval or general.frame_interval_seconds)
        yield FilmFiles(row["film"], path.parent / row["truth"], tracks, detections, video, calibration)


def _size(word: str | None, line: int, path: Path) -> float | None:
    if not word:
        return None
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise InvalidInputError(f"line {line} of {path} has {word!r}, expected a positive number")
    return value
