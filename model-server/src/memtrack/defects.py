# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels of the camera that are stuck or blink, which would swim through the scene once its drift is taken out.

Told by what no lens can draw: a single pixel far from all of its neighbours, in frame after frame.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from jaxtyping import Bool, Int, Shaped

from memtrack.film import Film, FilmOver

Frame = Shaped[np.ndarray, "h w"]

SAMPLES = 24
OFTEN = 0.2
"""Share of the frames in which a defective pixel stands out; what swims covers one pixel for less than that."""
SIGNIFICANT = 8.0
"""Standard deviations of a pixel from the median around it, and no less than `LEAST_STEPS` grey levels."""
LEAST_STEPS = 4.0
ALONE = 0.3
"""What is sharp, but seen through a lens, reaches its neighbours with a third of its height and more."""
MOST = 0.005
"""Share of defective pixels above which it is not the camera but the kind of image."""


@dataclass(frozen=True, slots=True)
class RepairedFilm(FilmOver):
    """`film` with the pixels at (`rows`, `columns`) replaced by the median of those around them."""

    rows: Int[np.ndarray, " n"]
    columns: Int[np.ndarray, " n"]

    def frame(self, index: int) -> Frame:
        """Frame `index`, a copy."""
        frame = self.film.frame(index)
        around = [
            frame[_inside(self.rows + y, self.height), _inside(self.columns + x, self.width)]
            for y, x in np.argwhere(_RING) - 1
        ]
        repaired = frame.copy()
        repaired[self.rows, self.columns] = np.sort(around, axis=0)[len(around) // 2]
        return repaired


def without_defects(film: Film) -> Film:
    """`film`, repaired where its camera has defective pixels; the same object where it has none."""
    if min(film.height, film.width) < 3 or film.frame_count < 2:
        return film
    chosen = np.unique(np.linspace(0, film.frame_count - 1, SAMPLES).astype(int))
    count = np.zeros((film.height, film.width), np.uint8)
    for i in chosen:
        count += _standing_out(film.frame(int(i)))
    defective = count >= max(2, OFTEN * len(chosen))
    if not defective.any() or defective.mean() > MOST:
        return film
    return RepairedFilm(film, *np.nonzero(defective))


def _standing_out(frame: Frame) -> Bool[np.ndarray, "h w"]:
    """Pixels far from the median around them whose neighbours all stay near it."""
    height = cv2.absdiff(frame, cv2.medianBlur(frame, 3))
    noise = 1.4826 * float(np.median(height[::3, ::3]))
    candidates: np.ndarray = height > max(SIGNIFICANT * noise, LEAST_STEPS if frame.dtype.kind == "u" else 0.0)
    if candidates.any():
        candidates &= cv2.dilate(height, _RING) < ALONE * height.astype(np.float32)
    return candidates


def _inside(places: Int[np.ndarray, " n"], size: int) -> Int[np.ndarray, " n"]:
    """`places`, at most one outside of [0, size), mirrored into it."""
    mirrored: np.ndarray = np.abs(places)
    return np.where(mirrored < size, mirrored, 2 * (size - 1) - mirrored)


_RING = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]], np.uint8)
