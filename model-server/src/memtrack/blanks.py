# SPDX-License-Identifier: GPL-3.0-or-later
"""Blank parts of a film: the black around a round field, bars at the sides, a scale bar and writing burnt into it.

They are no texture of the scene, and stand still where it drifts. Told by what no scene does: a part stays at the
film's darkest or brightest value, at the border of the frame or, where all else has noise, to the bit; and it ends at a
sharp step. It is filled with what surrounds it, out of focus, so that no later step needs to know of it.
"""

from __future__ import annotations

from collections.abc import Iterator
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
"""Shares of the frame: a smaller part at the border is left alone, and where more is blank it is the kind of image."""
LEAST_PX = 500
"""A smaller part, in pixels, may be a grain of a medium so dark that the camera cuts it off."""
BAR_PX, LONG, SOLID = 100, 5, 0.8
"""A scale bar has more pixels, is so many times longer than high, and fills so much of the rectangle around it. Writing
is looked for where there is one."""
DIGIT_PX, WIDE = 12, 1.5
"""Digits stand nearer to each other than this; a line of writing with half of this around it is wider than high."""
WRITTEN = 0.03
"""Share of the frame at the end of the range above which it is the scene that saturates there."""
STILL = 0.001
"""Share of other pixels that stay the same to the bit, from which that says nothing, as in packed films."""
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
    if not blank.any() or blank.mean() > MOST:
        return film
    level = float(mean[~blank].mean())
    if not level > 0:
        return film
    rows, columns = np.nonzero(blank)
    return FilledFilm(film, rows, columns, _surroundings(mean, blank)[blank], level)


def _blank(
    lowest: Float32[np.ndarray, "h w"], highest: Float32[np.ndarray, "h w"], mean: Float32[np.ndarray, "h w"]
) -> Bool[np.ndarray, "h w"]:
    """Parts that stay at one end of the film's range and end at a step, with what blends into them."""
    bottom, top = float(lowest.min()), float(highest.max())
    if not np.isfinite(top - bottom):
        return np.zeros(mean.shape, bool)
    dark, bright = (float(np.quantile(mean, share)) for share in (0.25, 0.75))
    still = lowest == highest
    noisy = (still & (lowest > bottom) & (highest < top)).mean() <= STILL
    blank = np.zeros(mean.shape, bool)
    for nearest, furthest, scene in (
        (lowest - bottom, highest - bottom, bright - bottom),
        (top - highest, top - lowest, top - dark),
    ):
        if scene > 0:
            blank |= _at_border(nearest, furthest, scene)
            if noisy:
                blank |= _written(nearest, furthest, scene)
    return blank


def _at_border(
    nearest: Float32[np.ndarray, "h w"], furthest: Float32[np.ndarray, "h w"], scene: float
) -> Bool[np.ndarray, "h w"]:
    """Parts at the border of the frame. Each pixel stands at least and at most so far from an end of the range, and the
    scene in general `scene`."""
    blank = np.zeros(nearest.shape, bool)
    for part, (x, y, w, h) in _parts(furthest <= FLAT * scene, max(LEAST * nearest.size, LEAST_PX)):
        at_border = x == 0 or y == 0 or x + w == nearest.shape[1] or y + h == nearest.shape[0]
        if at_border and _ends_sharply(part, nearest, scene):
            blank |= _grown(part, 1)
    return blank


def _written(
    nearest: Float32[np.ndarray, "h w"], furthest: Float32[np.ndarray, "h w"], scene: float
) -> Bool[np.ndarray, "h w"]:
    """A scale bar, which stays at an end of the range to the bit, and lines of writing at the same end, of which some
    does: the digits of a running clock are there now and then. Arguments as above."""
    written = np.zeros(nearest.shape, bool)
    ink, touched = furthest == 0, nearest == 0
    bars = [bar for bar, (_, _, w, h) in _parts(ink, BAR_PX) if w >= LONG * h and bar.sum() >= SOLID * w * h]
    if touched.mean() > WRITTEN or not any(_ends_sharply(bar, nearest, scene) for bar in bars):
        return written
    for line, (_, _, w, h) in _parts(_grown(touched, DIGIT_PX // 2), BAR_PX):
        if w >= WIDE * h and (line & ink).any():
            written = written | line & touched
    whole: np.ndarray = cv2.morphologyEx(
        _grown(written, 2).astype(np.uint8), cv2.MORPH_CLOSE, np.ones((9, 9), np.uint8)
    )
    return whole > 0


def _parts(mask: Bool[np.ndarray, "h w"], least: float) -> Iterator[tuple[Bool[np.ndarray, "h w"], list[int]]]:
    """Each connected part of `mask` of `least` pixels or more, with its left, top, width and height."""
    _, labels, statistics, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8))
    for number in np.flatnonzero(statistics[:, cv2.CC_STAT_AREA] >= least):
        if number > 0:  # what is not of the mask
            yield labels == number, statistics[number, :4].tolist()


def _ends_sharply(part: Bool[np.ndarray, "h w"], nearest: Float32[np.ndarray, "h w"], scene: float) -> bool:
    rim = nearest[_grown(part, 3) & ~_grown(part, 1)]
    return bool(len(rim)) and bool(np.quantile(rim, 0.25) > STEP * scene)


def _grown(part: Bool[np.ndarray, "h w"], by: int) -> Bool[np.ndarray, "h w"]:
    """`part` and all pixels at most `by` from it along both axes."""
    return np.asarray(cv2.dilate(part.astype(np.uint8), np.ones((2 * by + 1,) * 2, np.uint8)) > 0)


def _surroundings(mean: Float32[np.ndarray, "h w"], blank: Bool[np.ndarray, "h w"]) -> Float32[np.ndarray, "h w"]:
    """At each blank pixel what the nearest pixel that is not blank shows, smoothed over its neighbours."""
    lit = (~blank).astype(np.float32)
    weight = cv2.GaussianBlur(lit, (0, 0), SMOOTH_PX)
    smooth = cv2.GaussianBlur(mean * lit, (0, 0), SMOOTH_PX) / np.maximum(weight, 1e-6)
    _, nearest = cv2.distanceTransformWithLabels(blank.astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    of_label = np.zeros(int(nearest.max()) + 1, np.float32)
    of_label[nearest[~blank]] = smooth[~blank]
    return of_label[nearest]
