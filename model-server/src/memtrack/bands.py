# SPDX-License-Identifier: GPL-3.0-or-later
"""Bands of light that roll through a film, as where a lamp flickers with the mains and the camera reads row by row.

They change each pixel by more than its noise, in which faint bacteria then drown. All pixels of a row share them.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import cycle, starmap

import cv2
import numpy as np
from jaxtyping import Bool, Float32, Float64, Shaped

from memtrack.film import Film, FilmOver

Frame = Shaped[np.ndarray, "h w"]

SAMPLES = 12
GAPS = (1, 2, 3, 4)
"""Frames between two that are compared, in turns: bands may roll slowly, or come back after some frames."""
NOTABLE = 0.3
"""How much of the noise bands must be to be taken out."""
OUTLYING = 3.0
"""What deviates from its row by more than so many standard deviations, as cells do, has no further say in it."""
SMOOTH_ROWS = 4.0
"""A band is broader than this (sigma)."""


@dataclass(frozen=True, slots=True)
class EvenFilm(FilmOver):
    """`film` without bands along `axis`: 0 for bands of columns, 1 for bands of rows.

    `usual`: the film's median. `noise`: of a pixel, in grey levels. `picture`: what is no caption, and may change.
    """

    axis: int
    usual: Float32[np.ndarray, "h w"]
    noise: float
    picture: Bool[np.ndarray, "h w"]

    def frame(self, index: int) -> Frame:
        """Frame `index`, a copy of the film's own type."""
        frame = self.film.frame(index)
        values = frame.astype(np.float32)
        lamp = float(self.usual.sum()) / float(values.sum() or 1)
        brighter = _profile(values * np.float32(lamp) - self.usual, self.axis, self.noise)
        level = self.usual.mean(axis=self.axis)
        factor = np.divide(level, level + brighter, out=np.ones_like(level), where=level + brighter > 0)
        even = values * np.expand_dims(factor, self.axis)
        if frame.dtype.kind == "u":
            even = np.clip(np.rint(even), 0, np.iinfo(frame.dtype).max)
        return np.where(self.picture, even.astype(frame.dtype), frame)


def without_bands(film: Film) -> Film:
    """`film`, freed of rolling bands; the same object where it has none that matter. Reads up to 36 frames."""
    if min(film.height, film.width) < 16 * SMOOTH_ROWS or film.frame_count < 2 * len(GAPS):
        return film
    chosen = np.unique(np.linspace(0, film.frame_count - 1 - max(GAPS), SAMPLES).astype(int)).tolist()
    pairs = ((film.frame(i), film.frame(i + gap)) for i, gap in zip(chosen, cycle(GAPS), strict=False))
    strengths, noises = zip(*starmap(_strengths, pairs), strict=True)
    typical = np.median(strengths, axis=0)
    axis = int(typical.argmax())
    if not typical[axis] >= NOTABLE:
        return film
    frames = np.stack([film.frame(i) for i in chosen])
    usual, noise = np.median(frames, axis=0).astype(np.float32), float(np.median(noises))
    if usual.mean(axis=axis).min() <= OUTLYING * noise:  # dark or signed values are no light that a lamp multiplies
        return film
    return EvenFilm(film, axis, usual, noise, np.ptp(frames, axis=0) > 0)


def _strengths(first: Frame, second: Frame) -> tuple[tuple[float, float], float]:
    """Standard deviations of bands of columns and of rows in units of the noise, and the noise, of two frames that
    follow each other: the scene is the same in both, and a band is not where it was. Those of most rows, since a wall
    that trembles changes some of them."""
    before, after = first.astype(np.float32), second.astype(np.float32)
    total = float(after.sum())
    change = after * np.float32(float(before.sum()) / total if total > 0 else 1) - before
    noise = 1.4826 * float(np.median(np.abs(change[::3, ::3])))
    if not noise > 0:
        return (0.0, 0.0), 0.0
    both = [_profile(change, axis, noise) for axis in (0, 1)]
    columns, rows = (1.4826 * float(np.median(np.abs(p - np.median(p)))) / noise for p in both)
    return (columns, rows), noise / float(np.sqrt(2))


def _profile(change: Float32[np.ndarray, "h w"], axis: int, noise: float) -> Float64[np.ndarray, " rows"]:
    """What each row, or column, has in common of a `change` of grey levels, smoothed."""
    limit, across = OUTLYING * noise, 1 - axis
    shared = np.zeros(change.shape[across])
    for _ in range(2):  # the second time around what the first one found, which clips all that is higher
        middle = np.expand_dims(shared.astype(np.float32), axis)
        shared = cv2.reduce(np.clip(change, middle - limit, middle + limit), axis, cv2.REDUCE_AVG).ravel()
    smooth: np.ndarray = cv2.GaussianBlur(shared[:, None], (0, 0), SMOOTH_ROWS, borderType=cv2.BORDER_REFLECT)
    return smooth[:, 0].astype(np.float64)
