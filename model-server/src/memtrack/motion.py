# SPDX-License-Identifier: GPL-3.0-or-later
"""The Motion Enhancer: motion features of a frame, as named channels of 8 bits (paper section "Motion Enhancer").

A `FeatureSpec` names the channels and their order; it is stored with every model, and a model only runs on its own.
Values are scaled by the film's own noise and texture, never by a frame's brightest pixel, so that one outlier does not
change the rest (the authors stretch each frame's flow from its minimum to its maximum).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from jaxtyping import UInt8

from memtrack.background import aligned_frame
from memtrack.channels import KNEE, NEUTRAL, Channel, Image, as_bytes, shading_of, signed
from memtrack.clouds import take_out_clouds
from memtrack.errors import SettingsError
from memtrack.flow import farneback_magnitude, lucas_kanade_magnitude
from memtrack.registration import overlap
from memtrack.scene import Scene
from memtrack.wobble import take_out_wobble

MEAN_GAIN = 2.0
"""How much larger than a single deviation the mean of eight is drawn, of which the noise is 0.35 times as large."""


@dataclass(frozen=True, slots=True)
class FeatureSpec:
    """Name, version and ordered channels of the features a model was trained on.

    Channels: `grey` (frame less its shading, in units of the scene's texture), `deviation` (frame less temporal median
    and less what a wobble of the medium explains, signed, in units of the film's noise), `deviation+2`, `deviation-5`
    ... (the same of a neighbouring frame, brought to this frame's place), `deviation-8:-1` (the mean of several),
    `spread` (the pixel's temporal spread, in units of the noise), `abs_deviation`, `flow` (Lucas-Kanade magnitude),
    `farneback` (the authors' flow, stretched per frame as they do), `frame` (grey levels), `median` (the median frame
    itself, as the authors' shipped path has it).
    """

    name: str
    version: int
    channels: tuple[str, ...]

    def __post_init__(self) -> None:
        unknown = [c for c in self.channels if not _NEIGHBOUR.fullmatch(c) and c not in _CHANNELS]
        if unknown or not self.channels:
            known = ", ".join([*_CHANNELS, "deviation+n", "deviation-n"])
            raise SettingsError(f"feature channels {unknown} are unknown: use some of {known}")


_NEIGHBOUR = re.compile(r"deviation([+-]\d{1,2})?(?::([+-]\d{1,2}))?")


class FilmFeatures:
    """Features of any frame of one film, computed when asked for; keeps those of a few frames.

    A film read forwards from its first frame computes each deviation once.
    """

    def __init__(self, scene: Scene, spec: FeatureSpec) -> None:
        self.film, self.motion, self.scene, self.spec = scene.film, scene.motion, scene, spec
        self._known: dict[int, tuple[Channel, Channel]] = {}
        # By the first and last offset of a mean: where the scene stood, which frames were added up, and their sum.
        self._sums: dict[tuple[int, int], tuple[tuple[int, int], range, Image]] = {}
        self._reach = max([abs(o) for c in spec.channels if _NEIGHBOUR.fullmatch(c) for o in _offsets(c)], default=0)

    def frame(self, index: int) -> UInt8[np.ndarray, "channel height width"]:
        """The `channels` of frame `index` as one array."""
        return np.stack(self.channels(index))

    def channels(self, index: int) -> list[Channel]:
        """Channels of frame `index`, on the grid of its aligned frame: a place found at (x, y) lies at
        (x, y) + the rest of the frame's drift (`split_drift`) of the film's own frame."""
        aligned: list[Image] = []

        def current() -> Image:
            if not aligned:
                aligned.append(aligned_frame(self.film, self.motion, index))
            return aligned[0]

        channels = [self._channel(name, index, current) for name in self.spec.channels]
        for old in [k for k in self._known if abs(k - index) > self._reach]:
            del self._known[old]
        return channels

    def deviation(self, index: int) -> Image:
        """How far frame `index`, aligned, deviates from the background, in units of the noise."""
        return self._deviation_values(index, aligned_frame(self.film, self.motion, index))

    def _channel(self, name: str, index: int, current: Callable[[], Image]) -> Channel:
        if _NEIGHBOUR.fullmatch(name):
            first, last = _offsets(name)
            return self._neighbour(index, first) if first == last else self._mean(index, first, last)
        return _CHANNELS[name](self, index, current)

    def _deviation_values(self, index: int, aligned: Image) -> Image:
        values: Image = aligned - self.scene.median(index)
        values *= np.float32(1 / self.scene.noise(index))
        if self.scene.clouded(index):
            take_out_clouds(values)
        else:
            # Cells are clipped before the shading is estimated, so that a bright one leaves no dark cloud around it.
            values -= shading_of(np.clip(values, -3, 3))
        take_out_wobble(values, self.scene.slopes(index))
        return values

    def _grey_and_deviation(self, index: int) -> tuple[Channel, Channel]:
        """Both at once, since the frame is read and aligned long before it is the current one."""
        if index in self.motion.unlit:
            neutral = np.full((self.film.height, self.film.width), NEUTRAL, np.uint8)
            return neutral, neutral
        if index not in self._known:
            aligned = aligned_frame(self.film, self.motion, index)
            grey = signed((aligned - self.scene.shading(index)) * np.float32(2 / self.scene.texture(index)))
            self._known[index] = grey, signed(self._deviation_values(index, aligned))
        return self._known[index]

    def _neighbour(self, index: int, offset: int) -> Channel:
        other = min(max(index + offset, 0), self.film.frame_count - 1)
        return self._at_place_of(index, other, self._grey_and_deviation(other)[1], NEUTRAL)

    def _mean(self, index: int, first: int, last: int) -> Channel:
        """Mean of the deviations of the frames from `index + first` to `index + last` that the film has: what moves
        slowly stands out of the noise. Its own noise is smaller, so it is drawn `MEAN_GAIN` times as large."""
        others = range(max(index + first, 0), min(index + last, self.film.frame_count - 1) + 1)
        if not others:
            return np.full((self.film.height, self.film.width), NEUTRAL, np.uint8)
        total = self._sum(index, (first, last), others)
        mean = cv2.addWeighted(total, MEAN_GAIN / len(others), total, 0, NEUTRAL * (1 - MEAN_GAIN), dtype=cv2.CV_8U)
        return np.asarray(mean, np.uint8)

    def _sum(self, index: int, key: tuple[int, int], others: range) -> Image:
        """Sum of the deviations of `others` where the scene stands in frame `index`: the last one under `key`, most of
        whose frames are the same, brought up to date if the scene stands as it did then."""
        place, height, width = self.scene.place(index), self.film.height, self.film.width
        known = self._sums.get(key)
        if known is None or known[0] != place or not set(known[1]) & set(others):
            known = place, range(0), np.zeros((height, width), np.float32)
        _, before, total = known
        for old in set(before) - set(others):
            total -= self._neighbour(index, old - index)
        for new in set(others) - set(before):
            cv2.accumulate(self._neighbour(index, new - index), total)
        self._sums[key] = place, others, total
        return total

    def _at_place_of(self, index: int, other: int, image: np.ndarray, missing: float) -> np.ndarray:
        """`image` of frame `other` where the scene stands in frame `index`."""
        shift = np.subtract(self.scene.place(other), self.scene.place(index))
        if not shift.any():
            return image
        moved = np.full_like(image, missing)
        target, source = overlap(image.shape, shift)
        moved[target] = image[source]
        return moved

    def _grey(self, index: int, current: Callable[[], Image]) -> Channel:
        return self._grey_and_deviation(index)[0]

    def _spread_channel(self, index: int, current: Callable[[], Image]) -> Channel:
        return self.scene.spread(index)

    def _abs_deviation(self, index: int, current: Callable[[], Image]) -> Channel:
        values = np.abs(self._deviation_values(index, current()))
        return as_bytes(255 * values / (values + np.float32(KNEE)))

    def _flow_with(self, flow: Callable[[Image, Image], Image], index: int, current: Callable[[], Image]) -> Image:
        before = max(index - 1, 0)  # frame 0 has no predecessor and no flow; it is not dropped
        previous = self._at_place_of(index, before, aligned_frame(self.film, self.motion, before), 0.0)
        return flow(previous, current())

    def _flow(self, index: int, current: Callable[[], Image]) -> Channel:
        def flow(previous: Image, now: Image) -> Image:
            return lucas_kanade_magnitude(previous, now, floor=self.scene.noise(index) ** 2)

        magnitude = self._flow_with(flow, index, current)
        return as_bytes(255 * magnitude / (magnitude + 1))

    def _farneback(self, index: int, current: Callable[[], Image]) -> Channel:
        magnitude = self._flow_with(farneback_magnitude, index, current)
        return as_bytes(cv2.normalize(magnitude, np.empty_like(magnitude), 0, 255, cv2.NORM_MINMAX))

    def _frame(self, index: int, current: Callable[[], Image]) -> Channel:
        return self._levels(index, current())

    def _median(self, index: int, current: Callable[[], Image]) -> Channel:
        return self._levels(index, self.scene.median(index))

    def _levels(self, index: int, image: Image) -> Channel:
        scale = np.float32(32 / self.scene.texture(index))
        return as_bytes(np.clip((image - self.scene.level(index)) * scale + NEUTRAL, 0, 255))


def _offsets(channel: str) -> tuple[int, int]:
    """First and last frame of a deviation channel, as offsets from the current one."""
    match = _NEIGHBOUR.fullmatch(channel)
    first = int(match[1]) if match and match[1] else 0
    return first, int(match[2]) if match and match[2] else first


_CHANNELS: dict[str, Callable[[FilmFeatures, int, Callable[[], Image]], Channel]] = {
    "grey": FilmFeatures._grey,
    "spread": FilmFeatures._spread_channel,
    "abs_deviation": FilmFeatures._abs_deviation,
    "flow": FilmFeatures._flow,
    "farneback": FilmFeatures._farneback,
    "frame": FilmFeatures._frame,
    "median": FilmFeatures._median,
}

MOTION = FeatureSpec(
    "motion",
    2,
    (
        *("grey", "deviation", "deviation-2", "deviation+2", "deviation-6", "deviation+6", "spread"),
        *("deviation-8:-1", "deviation+1:+8"),
    ),
)
"""Ours: the signed deviation of the frame, of four neighbours and of the eight frames before and after, the frame, and
how restless each pixel is."""
PAPER = FeatureSpec("paper", 1, ("frame", "flow", "abs_deviation"))
"""The paper's three channels."""
AUTHORS = FeatureSpec("authors", 1, ("frame", "farneback", "median"))
"""What the MEMTrack authors' shipped code feeds its nets."""
SPECS = {spec.name: spec for spec in (MOTION, PAPER, AUTHORS)}
