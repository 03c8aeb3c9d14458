# SPDX-License-Identifier: GPL-3.0-or-later
"""A film as the method sees it: grey frames that can be read in any order, with their calibration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Shaped


@dataclass(frozen=True, slots=True)
class Calibration:
    """Physical scale of a film; None where the film does not say.

    pixel_size_um: edge of a square pixel in micrometres. frame_interval_seconds: time between two frames.
    """

    pixel_size_um: float | None = None
    frame_interval_seconds: float | None = None


@runtime_checkable
class Film(Protocol):
    """Grey frames of one shape and type (uint8, uint16 or float32), readable in any order and more than once."""

    @property
    def frame_count(self) -> int: ...

    @property
    def height(self) -> int: ...

    @property
    def width(self) -> int: ...

    @property
    def calibration(self) -> Calibration: ...

    def frame(self, index: int) -> Shaped[np.ndarray, "height width"]:
        """Frame `index`, from 0. The caller does not change the array."""
        ...


@dataclass(frozen=True, slots=True)
class ArrayFilm:
    """A film that is already in memory."""

    frames: Shaped[np.ndarray, "frame height width"]
    calibration: Calibration = Calibration()

    @property
    def frame_count(self) -> int:
        return int(self.frames.shape[0])

    @property
    def height(self) -> int:
        return int(self.frames.shape[1])

    @property
    def width(self) -> int:
        return int(self.frames.shape[2])

    def frame(self, index: int) -> Shaped[np.ndarray, "height width"]:
        frame: np.ndarray = self.frames[index]
        return frame


@dataclass(frozen=True, slots=True)
class FilmOver:
    """Base of films that show the frames of `film` changed: of its size and scale, unless they say otherwise."""

    film: Film

    @property
    def frame_count(self) -> int:
        return self.film.frame_count

    @property
    def height(self) -> int:
        return self.film.height

    @property
    def width(self) -> int:
        return self.film.width

    @property
    def calibration(self) -> Calibration:
        return self.film.calibration
