# SPDX-License-Identifier: GPL-3.0-or-later
"""A small film for the tests of reading, and what must hold of one that was read."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from memtrack.film import Calibration
from memtrack.video import OpenedFilm, open_film

FILM = np.random.default_rng(0).integers(0, 250, (12, 9, 14)).astype(np.uint8)
HARD_NAME = "Film [1] für 细菌 ü"


def frames(film: OpenedFilm) -> np.ndarray:
    read = np.stack([film.frame(i) for i in range(film.frame_count)])
    assert read.shape == (film.frame_count, film.height, film.width)
    return read


def check(path: Path, expected: np.ndarray, notes: tuple[str, ...] = ()) -> Calibration:
    """Reads the film at `path`; its frames must be `expected`, in value and type."""
    with open_film(path) as film:
        read = frames(film)
        np.testing.assert_array_equal(read, expected)
        assert read.dtype == expected.dtype
        assert film.notes == notes
        # Any order, more than once.
        np.testing.assert_array_equal(film.frame(film.frame_count - 1), expected[-1])
        np.testing.assert_array_equal(film.frame(0), expected[0])
        return film.calibration
