# SPDX-License-Identifier: GPL-3.0-or-later
"""Films as folders with one image a frame."""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from jaxtyping import Shaped

from memtrack.errors import FilmError
from memtrack.video.source import Source, decode, grey, notes_on
from memtrack.video.tiff import read_tiff

SUFFIXES = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp")


@contextlib.contextmanager
def open_folder(folder: Path) -> Iterator[Source]:
    """The images in `folder` in natural order of their names (2 before 10); all of one suffix.

    Raises:
        FilmError: there are none, or of several kinds, or the folder or its first image cannot be read.
    """
    try:
        images = [f for f in folder.iterdir() if f.suffix.lower() in SUFFIXES and not f.name.startswith(".")]
        files = sorted((f for f in images if not f.is_dir()), key=lambda f: natural(f.name))
    except OSError as error:
        raise FilmError(f"cannot read the folder {folder}: {error.strerror}; check its rights") from error
    if not files:
        raise FilmError(f"the folder {folder} has no images ({', '.join(SUFFIXES)}); give one with a PNG a frame")
    kinds = sorted({f.suffix.lower() for f in files})
    if len(kinds) > 1:
        raise FilmError(f"the folder {folder} has images of several kinds ({', '.join(kinds)}); leave one kind in it")
    first = _read(files[0])
    height, width = grey(first).shape
    yield Source(len(files), height, width, lambda i: _read(files[i]), notes=notes_on(first))


def natural(name: str) -> list[tuple[float, str]]:
    """A sort key in which numbers count by their value and come before letters."""
    parts = [part for part in re.split(r"(\d+)", name.lower()) if part]
    return [(int(part), "") if part.isdecimal() else (math.inf, part) for part in parts]


def _read(file: Path) -> Shaped[np.ndarray, "..."]:
    if file.suffix.lower() in (".tif", ".tiff"):
        return read_tiff(file)
    try:
        content = file.read_bytes()
    except OSError as error:
        raise FilmError(f"cannot read {file}: {error.strerror}; check the file and its rights") from error
    return decode(content, file.name)
