# SPDX-License-Identifier: GPL-3.0-or-later
"""Stage drift and lamp flicker of a film, measured against its own static scene.

A drift of a few pixels or a flicker of 2 % ruins a per-pixel median, so both are taken out before it. The drift is
found by registration of each frame, in blocks whose estimates must agree: where they do not, as in clear water that
shows nothing but swimmers, there is nothing to stabilise on.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import cv2
import numpy as np
from jaxtyping import Float32, Float64, Shaped

from memtrack.cuts import SceneChanges, ScenePart
from memtrack.errors import FilmError
from memtrack.film import Film
from memtrack.lookahead import ahead
from memtrack.registration import MIN_EDGE, Image, Reference, likeness, overlap, register, typical_likeness
from memtrack.resampling import read_shifted

Progress = Callable[[int, int], None]
Frame = Shaped[np.ndarray, "h w"]

AGREEMENT_PX = 0.12
"""Standard error of the blocks' common shift above which a film counts as having no static scene."""
SHARED_SCENE = ((0.5, 0.76), (0.25, 0.95))
"""Frames share a scene if they are so like it (median correlation), and the scenes of two halves of the film so like
each other. The second way is for noise or a passing body that outshines the scene in single frames. 35 of 36 simulated
films without their background, whose noise may line up by a drift that is none, are let through neither way, and 16 of
459 others."""
SCENE_EVERYWHERE = 0.5
"""And the two halves' scenes must be so alike in most blocks of the field. Where all frames were laid over one bright
swimmer on black, which passed for the scene, that is 0.0 to 0.1; in 108 simulated films that show a scene, 0.9 or more.
"""
NO_SHARED_SCENE = (
    "The frames share no scene, as where nothing but cells is seen, so no drift of the stage could be told, "
    "and none was undone."
)
REFERENCE_FRAMES = 25
LEAST_LIKENESS = 0.3
"""Correlation with the reference from which an image shows the same scene; by chance two differ by up to a fifth."""
LOST_LIKENESS = 0.4
"""Share of a film's usual likeness below which a frame, a dark one for example, does not show the scene."""
LEAST_EDGE_PX = 4 * MIN_EDGE
"""Drift is looked for at a quarter of the size first, in frames as wide and high as this."""
FIRST_FRAMES = 5
"""Of these any may turn out to be the first one that shows the scene."""


@dataclass(frozen=True, slots=True)
class FilmMotion:
    """Per frame: `drift` (x, y), how far the scene stands from its place in frame 0, in pixels; `gain`, the factor
    that brings the frame to the film's usual brightness. `ceiling`: the highest grey level, after that correction, that
    all frames can show; when the lamp grows brighter, a camera at its limit does not, and the scene seems to darken.
    `pattern`: grey levels that the camera adds to every frame, None for none. `unlit`: frames so dark or so bright that
    they hold nothing to find, as while the lamp is off. `cuts`: first frames of another scene in the same place
    (`memtrack.cuts`). `unmeasured`: why no drift was measured though it was wanted, a sentence for the user; empty
    where it was, or was not wanted."""

    drift: Float64[np.ndarray, "frame 2"]
    gain: Float64[np.ndarray, " frame"]
    ceiling: float = math.inf
    pattern: Image | None = None
    unlit: frozenset[int] = frozenset()
    cuts: tuple[int, ...] = ()
    unmeasured: str = ""

    def sampled(self, frames: range, most: int) -> list[int]:
        """Up to `most` of consecutive `frames`, spread evenly, in their order; unlit ones only where all are."""
        lit = [i for i in frames if i not in self.unlit] or frames
        return [lit[int(k)] for k in np.linspace(0, len(lit) - 1, min(len(lit), most))]

    def corrected(self, values: Image, index: int, rows: slice = slice(None)) -> Image:
        """Frame `index`, or some rows of it, as an even lamp and a clean camera would have it taken; works in place."""
        if self.gain[index] != 1:
            values *= np.float32(self.gain[index])
            np.minimum(values, np.float32(self.ceiling), out=values)
        if self.pattern is not None:
            values -= self.pattern[rows]
        return values


def measure_motion(film: Film, *, stabilise: bool, report: Progress, threads: int = 1) -> FilmMotion:
    """Measures drift (when `stabilise`) and gain of every frame; `report(done, total)` is called once a frame and pass.

    First pass at a quarter of the size against the first frame (or, far from it, a later one), second at half the
    size against the median of the frames aligned so far. `threads` only changes how long it takes.

    Raises:
        FilmError: a frame holds a NaN or an infinite value.
    """
    count = film.frame_count
    shrinks, unmeasured = stabilise and count > 1, ""
    if shrinks and min(film.height, film.width) < LEAST_EDGE_PX:
        shrinks = False
        unmeasured = (
            f"At the model's scale the frames have {film.width} x {film.height} pixels; a drift of the stage is undone "
            f"from {LEAST_EDGE_PX} x {LEAST_EDGE_PX} pixels on, so none was."
        )
    passes = 2 if shrinks else 1
    means, lowest, brightest = np.empty(count), math.inf, -math.inf
    chain = _Chain()
    drift = np.zeros((count, 2))
    frames = (film.frame(i) for i in range(count))
    with ahead(partial(_summary, shrink=4 if shrinks else None), frames, threads) as summaries:
        for i, (mean, low, high, small) in enumerate(summaries):
            if not math.isfinite(mean):
                raise FilmError(
                    f"frame {i + 1} of the {count} used holds values that are not finite (NaN or infinity): replace "
                    "them, NaN with Process > Noise > Remove NaNs, infinity with Remove Outliers, and run again"
                )
            means[i], lowest, brightest = mean, min(lowest, low), max(brightest, high)
            if small is not None:
                drift[i] = chain.add(small) * 4
            report(i + 1, passes * count)
    gain, unlit = _gains(means, lowest)
    # A few flashes do not lower the ceiling of the whole film.
    motion = FilmMotion(drift, gain, brightest * float(np.quantile(gain, 0.05)), unlit=unlit, unmeasured=unmeasured)
    return _refined(film, motion, report, threads) if shrinks else motion


def _summary(
    values: Frame, shrink: int | None
) -> tuple[float, float, float, Float32[np.ndarray, "small_h small_w"] | None]:
    """Mean, not finite where any value is not, lowest and highest value of a frame, and its band-pass."""
    frame = values.astype(np.float32)
    if not np.isfinite(cv2.norm(frame, cv2.NORM_L1)):
        return math.nan, math.nan, math.nan, None
    bands = None if shrink is None else _band_pass(frame, shrink)
    return cv2.mean(frame)[0], float(frame.min()), float(frame.max()), bands


def _gains(means: Float64[np.ndarray, " frame"], lowest: float) -> tuple[Float64[np.ndarray, " frame"], frozenset[int]]:
    """The factor for each frame, and the frames that no factor helps; these are few, or the means say nothing of the
    lamp, as in dark images, and in signed ones, whose values reach as far below 0 as the means lie above it."""
    usual = float(np.median(means))
    lit = (means > 0.2 * usual) & (means < 5 * usual)
    if usual <= max(0, -lowest) or lit.mean() < 0.9:
        return np.ones(len(means)), frozenset()
    gain = np.divide(usual, means, out=np.ones(len(means)), where=lit)
    return gain, frozenset(np.flatnonzero(~lit).tolist())


def _refined(film: Film, motion: FilmMotion, report: Progress, threads: int) -> FilmMotion:
    """With the drift measured anew, at half the size, and the cuts of the scene; with none of both where the frames
    share no scene to tell them by."""
    count, drift = film.frame_count, motion.drift
    chosen = np.unique(np.linspace(0, count - 1, REFERENCE_FRAMES).astype(int))
    # The reference covers the field of the middle of the drift, where most frames overlap it.
    origin = np.median(drift, axis=0)
    aligned = [_aligned(_band_pass(film.frame(int(i)).astype(np.float32), 2), (drift[i] - origin) / 2) for i in chosen]
    reference = Reference(_median_where_known(np.stack(aligned)))
    halves = [_median_where_known(np.stack(half)) for half in (aligned[::2], aligned[1::2])]
    repeated, everywhere = likeness(Reference(halves[0]), halves[1], np.zeros(2)), typical_likeness(*halves)

    middle, changes = ScenePart.of(film, drift), SceneChanges()

    def place(item: tuple[int, Frame]) -> tuple[Float64[np.ndarray, " 2"], float, float, np.ndarray]:
        i, frame = item
        values = frame.astype(np.float32)
        image = _band_pass(values, 2)
        shift, error = register(reference, image, (drift[i] - origin) / 2, steps=3)
        stands = 2 * shift + origin
        part = middle.seen_in(values, stands) * np.float32(motion.gain[i])
        return stands, error, likeness(reference, image, shift), part

    refined, errors, alike = drift.copy(), np.zeros(count), np.zeros(count)
    frames = ((i, film.frame(i)) for i in range(count))
    with ahead(place, frames, threads) as places:
        for i, (refined[i], errors[i], alike[i], part) in enumerate(places):
            if i not in motion.unlit:
                changes.add(i, part)
            report(count + i + 1, 2 * count)
    shared = any(np.median(alike) >= least and repeated >= enough for least, enough in SHARED_SCENE)
    if np.median(errors) * 2 > AGREEMENT_PX or everywhere < SCENE_EVERYWHERE or not shared:
        return replace(motion, drift=np.zeros_like(drift), unmeasured=NO_SHARED_SCENE)
    lost = (errors * 2 > 4 * AGREEMENT_PX) | (alike < LOST_LIKENESS * np.median(alike))
    if lost.any() and not lost.all():
        good = np.flatnonzero(~lost)
        for axis in range(2):
            refined[lost, axis] = np.interp(np.flatnonzero(lost), good, refined[good, axis])
    return replace(motion, drift=refined - refined[0], cuts=changes.cuts(count))


class _Chain:
    """Drift of successive images against the first; a new reference is taken where too little of it is left.

    An image that fits far worse than usual is looked for anywhere, since a stage may jump, but only a place where it is
    like the reference counts: a blank frame, or a scene that changes, fits somewhere by chance. Where there is no such
    place, the stage is taken to stand where it was.
    """

    def __init__(self) -> None:
        self._reference: Reference | None = None
        self._origin = np.zeros(2)
        self._last = np.zeros(2)
        self._usual_error = np.inf
        self._begun = 0

    def add(self, image: Image) -> Float64[np.ndarray, " 2"]:
        reference = self._reference
        self._begun += 1
        if reference is None:
            self._reference = Reference(image)
            return self._last
        shift, error = register(reference, image, self._last - self._origin, steps=5)
        begins = np.isinf(self._usual_error) and self._begun <= FIRST_FRAMES
        if begins and likeness(reference, image, shift) < LEAST_LIKENESS:
            self._reference = Reference(image)  # the first frames may be dark, or of another place
            return self._last
        if not error <= 3 * self._usual_error:
            window = cv2.createHanningWindow(image.shape[::-1], cv2.CV_32F)
            jump, _ = cv2.phaseCorrelate(reference.image, image, window)
            places = [(shift, error), register(reference, image, np.array(jump), steps=5)]
            alike = [likeness(reference, image, place[0]) for place in places]
            shift, error = places[int(np.argmax(alike))]
            if max(alike) < LEAST_LIKENESS:
                return self._last
        self._usual_error = error if np.isinf(self._usual_error) else 0.9 * self._usual_error + 0.1 * error
        self._last = self._origin + shift
        if np.any(np.abs(shift) > 0.2 * np.array(image.shape[::-1])):
            self._reference, self._origin = Reference(image), self._last
        return self._last


def _band_pass(frame: Image, shrink: int) -> Float32[np.ndarray, "small_h small_w"]:
    """`frame` at 1/`shrink` of its size, without shading and finer noise, of one contrast under any lamp."""
    h, w = (edge // shrink for edge in frame.shape)
    small = cv2.resize(frame[: h * shrink, : w * shrink], (w, h), interpolation=cv2.INTER_AREA)
    bands: np.ndarray = cv2.GaussianBlur(small, (0, 0), 1.0) - cv2.blur(small, (17, 17))
    contrast = cv2.norm(bands, cv2.NORM_L1) / bands.size
    if contrast > 0:
        bands *= np.float32(1 / contrast)
    return bands


def _aligned(image: Image, drift: Float64[np.ndarray, " 2"]) -> Image:
    """`image` read at (x + drift), NaN where that lies outside it."""
    whole = np.rint(drift).astype(int)
    moved = read_shifted(image, *(drift - whole))
    out = np.full_like(image, np.nan)
    target, source = overlap(image.shape, whole)
    out[target] = moved[source]
    return out


def _median_where_known(images: Float32[np.ndarray, "n h w"]) -> Image:
    """Median over the images that are not NaN at a pixel, 0 where all are; NaNs sort to the end."""
    n, h, w = images.shape
    ranked = np.sort(np.ascontiguousarray(images.reshape(n, -1).T), axis=1)
    known = n - np.isnan(ranked).sum(axis=1)
    middle = ranked[np.arange(h * w), np.maximum(known - 1, 0) // 2]
    median: np.ndarray = np.nan_to_num(middle).reshape(h, w)
    return median
