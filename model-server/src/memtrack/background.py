# SPDX-License-Identifier: GPL-3.0-or-later
"""The static scene of a film: per-pixel temporal median and spread, on a canvas that holds the whole drift."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from jaxtyping import Float32, Float64, Shaped, UInt16

from memtrack.film import Film
from memtrack.lookahead import ahead
from memtrack.resampling import HALF_WIDTH, read_shifted
from memtrack.stabilisation import FilmMotion

Progress = Callable[[int, int], None]

SAMPLES = 96
"""Frames the median is taken of; more than this changes it by less than a tenth of the noise."""
STRIP_BYTES, STRIP_BYTES_PER_PIXEL = 24 << 20, 64
"""What the samples of a strip may take, or for each pixel of a larger frame; the features take three times as much.
Each strip reads all samples anew, so a larger frame has larger strips, not more."""
LOWEST, HIGHEST = -64.0, 448.0
"""Grey levels of 8-bit films with room for a lamp's correction and the overshoot of resampling; they sort quicker in 16
bits. Other films are sorted as they are, since one outlier would set the range for all."""


@dataclass(frozen=True, slots=True)
class Background:
    """Median and spread of a stabilised film, in grey levels after gain correction.

    `median[y, x]` belongs to place (x + origin[0], y + origin[1]) of frame 0; `spread` is half the distance between
    the 16th and 84th percentile (a standard deviation, where the noise is normal); `noise` the film's typical spread.
    """

    median: Float32[np.ndarray, "canvas_height canvas_width"]
    spread: Float32[np.ndarray, "canvas_height canvas_width"]
    origin: tuple[int, int]
    noise: float

    def window(self, whole_drift: tuple[int, int], height: int, width: int) -> tuple[slice, slice]:
        """The part of the canvas that a frame shows whose scene stands `whole_drift` (x, y) pixels from frame 0's."""
        x, y = -whole_drift[0] - self.origin[0], -whole_drift[1] - self.origin[1]
        return slice(y, y + height), slice(x, x + width)


def split_drift(drift: Float64[np.ndarray, " 2"]) -> tuple[tuple[int, int], tuple[float, float]]:
    """Whole pixels and the rest, which lies in [-0.5, 0.5], of a drift (x, y)."""
    whole = np.rint(drift).astype(int)
    rest = drift - whole
    return (int(whole[0]), int(whole[1])), (float(rest[0]), float(rest[1]))


def aligned_frame(film: Film, motion: FilmMotion, index: int) -> Float32[np.ndarray, "height width"]:
    """Frame `index`, corrected and moved back by the part of its drift below one pixel."""
    return aligned(film.frame(index), motion, index, range(film.height))


def aligned(
    frame: Shaped[np.ndarray, "height width"], motion: FilmMotion, index: int, rows: range
) -> Float32[np.ndarray, "rows width"]:
    """These rows of `aligned_frame`, from what the film has as frame `index`."""
    first, end = max(0, rows.start - HALF_WIDTH), min(len(frame), rows.stop + HALF_WIDTH)
    values = motion.corrected(frame[first:end].astype(np.float32), index, slice(first, end))
    return read_shifted(values, *split_drift(motion.drift[index])[1])[rows.start - first : rows.stop - first]


def temporal_background(
    film: Film, motion: FilmMotion, *, report: Progress, frames: range | None = None, threads: int = 1
) -> Background:
    """Median and spread over up to `SAMPLES` frames spread evenly over the film, or over consecutive `frames` of it
    (paper section "Motion Enhancer"); the canvas holds what these show.

    Works in strips of rows, so that memory does not grow with the film; `report(done, total)` is called for each
    frame read. `threads` only changes how long it takes.
    """
    h, w = film.height, film.width
    within = range(film.frame_count) if frames is None else frames
    chosen = motion.sampled(within, SAMPLES)
    places = {i: split_drift(motion.drift[i])[0] for i in within}
    xs, ys = [-x for x, _ in places.values()], [-y for _, y in places.values()]
    origin = (min(xs), min(ys))
    canvas_w, canvas_h = max(xs) - origin[0] + w, max(ys) - origin[1] + h
    first = film.frame(chosen[0])
    packed = first.dtype == np.uint8
    dtype = np.dtype(np.uint16 if packed else np.float32)
    # Places that no frame shows get `low`.
    low, scale = (LOWEST, 65530 / (HIGHEST - LOWEST)) if packed else (float(np.median(first)), 1.0)
    budget = max(STRIP_BYTES, STRIP_BYTES_PER_PIXEL * canvas_h * canvas_w)
    rows = int(np.clip(budget // (dtype.itemsize * len(chosen) * canvas_w), 1, canvas_h))
    starts = range(0, canvas_h, rows)
    median = np.empty((canvas_h, canvas_w), np.float32)
    spread = np.empty((canvas_h, canvas_w), np.float32)
    done = 0

    def put(stack: np.ndarray, start: int, sample: tuple[int, np.ndarray]) -> None:
        """What a sample shows of the canvas from row `start` on, into its image of the stack."""
        k, frame = sample
        image, i = stack[k], chosen[k]
        top, left = -places[i][1] - origin[1], -places[i][0] - origin[0]
        a, b = max(start, top), min(start + len(image), top + h)
        if a < b:
            part = aligned(frame, motion, i, range(a - top, b - top)) - low
            if packed:
                part = np.clip(part, 0, HIGHEST - LOWEST) * scale + 0.5
            image[a - start : b - start, left : left + w] = part

    for start in starts:
        height = min(rows, canvas_h - start)
        stack = np.full((len(chosen), height, canvas_w), _missing(dtype), dtype)
        samples = ((k, film.frame(i)) for k, i in enumerate(chosen))
        with ahead(partial(put, stack, start), samples, threads) as images:
            for _ in images:
                done += 1
                report(done, len(chosen) * len(starts))
        middle, width = _order_statistics(stack, threads)
        median[start : start + height] = middle / scale + low
        spread[start : start + height] = width / scale
    seen = spread > 0
    return Background(median, spread, origin, float(np.median(spread[seen])) if seen.any() else 0.0)


def _missing(dtype: np.dtype[Any]) -> float:
    """The value that says that a frame does not show a place: the highest, so that it is sorted last."""
    return float(np.iinfo(dtype).max if dtype.kind == "u" else np.finfo(dtype).max)


def _order_statistics(
    stack: UInt16[np.ndarray, "n h w"] | Float32[np.ndarray, "n h w"],
    threads: int,
) -> tuple[Float32[np.ndarray, "h w"], Float32[np.ndarray, "h w"]]:
    """Median and half the 16-84 % range over the values that are not missing; 0 where there are none.

    Sorts rows that lie together in memory: many times quicker than np.median along the first axis. Integers of 32 bits,
    which numpy sorts four times as fast as those of 16 where the processor has no AVX-512.
    """
    n, h, w = stack.shape
    sorted_as = np.uint32 if stack.dtype == np.uint16 else stack.dtype
    missing = _missing(stack.dtype)
    middle, width = np.zeros(h * w, np.float32), np.zeros(h * w, np.float32)
    flat = stack.reshape(n, h * w)
    step = 1 << 15

    def part(a: int) -> None:
        values = np.sort(np.ascontiguousarray(flat[:, a : a + step].T, sorted_as), axis=1)
        size = (values != missing).sum(axis=1) if values[:, -1].max() == missing else np.full(len(values), n)
        at = np.arange(len(values))

        def quantile(q: float, values: np.ndarray = values, size: np.ndarray = size, at: np.ndarray = at) -> np.ndarray:
            place = q * np.maximum(size - 1, 0)
            lower = place.astype(np.int64)
            upper = np.minimum(lower + 1, np.maximum(size - 1, 0))
            share = (place - lower).astype(np.float32)
            below, above = (values[at, k].astype(np.float32) for k in (lower, upper))
            return np.where(size > 0, below * (1 - share) + above * share, 0)

        middle[a : a + step] = quantile(0.5)
        width[a : a + step] = (quantile(0.8413) - quantile(0.1587)) / 2

    with ThreadPoolExecutor(threads, "background") as pool:
        list(pool.map(part, range(0, h * w, step)))
    return middle.reshape(h, w), width.reshape(h, w)
