# SPDX-License-Identifier: GPL-3.0-or-later
"""The one way to open a film, whatever its file format."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Shaped

from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.video.container import open_container
from memtrack.video.folder import open_folder
from memtrack.video.source import Source
from memtrack.video.tiff import open_tiff

TIFF_SUFFIXES = (".tif", ".tiff", ".btf", ".tf8")
VIDEO_SUFFIXES = (".avi", ".mp4", ".mov", ".mkv", ".m4v", ".wmv")


@dataclass(frozen=True, slots=True)
class OpenedFilm:
    """A film from a file; `notes` has one sentence for each thing that was changed or assumed."""

    source: Source
    calibration: Calibration
    notes: tuple[str, ...]

    @property
    def frame_count(self) -> int:
        return self.source.frame_count

    @property
    def height(self) -> int:
        return self.source.height

    @property
    def width(self) -> int:
        return self.source.width

    def frame(self, index: int) -> Shaped[np.ndarray, "height width"]:
        """Frame `index`, from 0."""
        return self.source.frame(index)


@contextlib.contextmanager
def open_film(path: Path, given: Calibration | None = None) -> Iterator[OpenedFilm]:
    """The film at `path`, for the length of the block; what `given` states goes before what the file says.

    Raises:
        FilmError: there is no film at `path`, or none that can be read.
    """
    try:
        there = path.exists()
    except OSError as error:
        raise FilmError(f"cannot read {path}: {error.strerror}; check the path and the rights") from error
    if not there:
        raise FilmError(f"there is no film {path}; give a TIFF, an AVI or a folder of PNG frames")
    if path.is_dir():
        opening = open_folder(path)
    elif path.suffix.lower() in TIFF_SUFFIXES:
        opening = open_tiff(path)
    elif path.suffix.lower() in VIDEO_SUFFIXES:
        opening = open_container(path)
    else:
        raise FilmError(
            f"{path.name} is no film this program reads; save it as TIFF or AVI, or give a folder of PNG frames"
        )
    given = given or Calibration()
    with opening as source:
        notes, interval = source.notes, source.calibration.frame_interval_seconds
        if path.suffix.lower() in VIDEO_SUFFIXES and interval is not None and given.frame_interval_seconds is None:
            notes += (
                f"The frame interval, {interval:.4g} s, is taken from the film's playback rate; if it was recorded at "
                "another rate, give its interval.",
            )
        yield OpenedFilm(source, _merged(given, source.calibration), notes)


def _merged(given: Calibration, found: Calibration) -> Calibration:
    return Calibration(
        found.pixel_size_um if given.pixel_size_um is None else given.pixel_size_um,
        found.frame_interval_seconds if given.frame_interval_seconds is None else given.frame_interval_seconds,
    )
