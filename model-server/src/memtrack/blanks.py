# SPDX-License-Identifier: GPL-3.0-or-later
"""Blank parts of a film: the black around a round field, bars at the sides. Their edges are no texture of the scene.

Told by what no scene does: at the border of the frame a part stays at the film's darkest or brightest value, and ends
at a sharp step. It is filled with what surrounds it, out of focus, so that no later step needs to know of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from jaxtyping import Bool, Float32, Int, Shaped

from memtrack.film import Film, FilmOver

Frame = Shaped[np.ndarray, "h w"]

SAMPLES = 24
FLAT = 0.03
"""A blank part stays this near to the darkest or brightest value, as a share of the scene's distance from it: the black
of a video is not quite black."""
STEP = 0.3
"""Share of that distance that most of its surroundings always keep."""
LEAST, MOST = 0.003, 0.6
"""Shares of the frame: a smaller part is left alone, and where more is blank it is the kind of image."""
LEAST_PX = 500
"""A smaller part, in pixels, may be a grain of a medium so dark that the camera cuts it off."""
SMOOTH_PX = 8.0


@dataclass(frozen=True, slots=True)
class FilledFilm(FilmOver):
    """`film` with the pixels at (`rows`, `columns`) replaced by `values`, brightened and dimmed with the rest of each
    frame, whose usual mean is `level`."""

    rows: Int[np.ndarray, " n"]
    columns: Int[np.ndarray, " n"]
    values: Float32[np.ndarray, " n"]
    level: float

    def frame(self, index: int) -> Frame:
        """Frame `index`, a copy."""
        filled = self.film.frame(index).copy()
        filled[self.rows, self.columns] = 0
        lit = float(filled.sum(dtype=np.float64)) / (filled.size - len(self.rows))
        values = self.values * np.float32(lit / self.level)
        if filled.dtype.kind == "u":
            values = np.clip(np.rint(values), 0, np.iinfo(filled.dtype).max)
        filled[self.rows, self.columns] = values
        return filled

    def lit(self, margin_px: float) -> Bool[np.ndarray, "h w"]:
        """Where the film shows something, and no blank part is nearer than `margin_px`."""
        seen = np.ones((self.height, self.width), np.uint8)
        seen[self.rows, self.columns] = 0
        return np.asarray(cv2.distanceTransform(seen, cv2.DIST_L2, 5) >= margin_px)


def without_blanks(film: Film) -> Film:
    """`film`, filled where parts of it are blank; the same object where none are."""
    chosen = np.unique(np.linspace(0, film.frame_count - 1, SAMPLES).astype(int))
    lowest = film.frame(0).astype(np.float32)
    highest, total = lowest.copy(), np.zeros_like(lowest)
    for i in chosen:
        frame = film.frame(int(i)).astype(np.float32)
        np.minimum(lowest, frame, out=lowest)
        np.maximum(highest, frame, out=highest)
        total += frame
    mean = total / np.float32(len(chosen))
    blank = _blank(lowest, highest, mean)
    if not LEAST <= blank.mean() <= MOST:
        return film
    level = float(mean[~blank].mean())
    if not level > 0:
        return film
    rows, columns = np.nonzero(blank)
    return FilledFilm(film, rows, columns, _surroundings(mean, blank)[blank], level)


def _blank(
    lowest: Float32[np.ndarray, "h w"], highest: Float32[np.ndarray, "h w"], mean: Float32[np.ndarray, "h w"]
) -> Bool[np.ndarray, "h w"]:
    """Parts at the border that stay at one end of the film's range and end at a step; with one pixel around them."""
    bottom, top = float(lowest.min()), float(highest.max())
    if not np.isfinite(top - bottom):
        return np.zeros(mean.shape, bool)
    dark, bright = (float(np.quantile(mean, share)) for share in (0.25, 0.75))
    return _at_end(lowest - bottom, highest - bottom, bright - bottom) | _at_end(
        top - highest, top - lowest, top - dark
    )


def _at_end(
    nearest: Float32[np.ndarray, "h w"], furthest: Float32[np.ndarray, "h w"], scene: float
) -> Bool[np.ndarray, "h w"]:
    """Blank parts at one end, from which each pixel stands at least and at most so far, and the scene in general."""
    blank = np.zeros(nearest.shape, bool)
    if not scene > 0:
        return blank
    stays: np.ndarray = furthest <= FLAT * scene
    count, labels, statistics, _ = cv2.connectedComponentsWithStats(stays.astype(np.uint8))
    for number in range(1, count):
        x, y, w, h, area = statistics[number]
        at_border = x == 0 or y == 0 or x + w == nearest.shape[1] or y + h == nearest.shape[0]
        if area < max(LEAST * nearest.size, LEAST_PX) or not at_border:
            continue
        part = (labels == number).astype(np.uint8)
        inner, outer = (cv2.dilate(part, np.ones((edge, edge), np.uint8)) > 0 for edge in (3, 7))
        rim = nearest[outer & ~inner]
        if len(rim) and np.quantile(rim, 0.25) > STEP * scene:
            blank |= cv2.dilate(part, np.ones((3, 3), np.uint8)) > 0
    return blank


def _surroundings(mean: Float32[np.ndarray, "h w"], blank: Bool[np.ndarray, "h w"]) -> Float32[np.ndarray, "h w"]:
    """At each blank pixel what the nearest pixel that is not blank shows, smoothed over its neighbours."""
    lit = (~blank).astype(np.float32)
    weight = cv2.GaussianBlur(lit, (0, 0), SMOOTH_PX)
    smooth = cv2.GaussianBlur(mean * lit, (0, 0), SMOOTH_PX) / np.maximum(weight, 1e-6)
    _, nearest = cv2.distanceTransformWithLabels(blank.astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    of_label = np.zeros(int(nearest.max()) + 1, np.float32)
    of_label[nearest[~blank]] = smooth[~blank]
    return of_label[nearest]
