# SPDX-License-Identifier: GPL-3.0-or-later
"""Spots of a film's still scene: what stands out of it and is as small as a bacterium, which the temporal median holds
where a bacterium stays in its place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np
from jaxtyping import Bool, Float32, Int64

from memtrack.background import Background, aligned_frame, split_drift
from memtrack.film import Film
from memtrack.stabilisation import FilmMotion

CONTRAST, CLEARNESS = 3.0, 3.0
"""A spot stands out so many times more than the noise, and than what is around it."""
CLEAR = 5.0
"""What may be a bacterium stands out so many times more than what is around it: not so in most gels, where grain is as
large as a bacterium and no one knows what is behind it."""
STEADY = 0.5
"""It must stand out more than this share of what varies there, or it is what a body left that lay there for a while."""
MOST = 500
"""Spots that are looked at, the strongest ones."""
REACH_PX = 7
"""Half the edge of the patch around a spot."""
SEPARATE_PX = 13
"""Spots nearer than this, along x and y, may be of one bacterium."""
SAMPLES = 48
"""Frames in which spots are looked at, spread evenly over those of the background."""

_ACROSS = np.arange(-REACH_PX, REACH_PX + 1)
RADIUS_PX = np.hypot(_ACROSS, _ACROSS[:, None])
"""How far each pixel of a patch lies from its centre."""

Patches = Float32[np.ndarray, "spot edge edge"]
Sample = tuple[Patches, Bool[np.ndarray, " spot"]]
"""What is around each spot in a frame, and whether that shows all of it."""


@dataclass(frozen=True, slots=True)
class Spots:
    """Places of a background where something as small as a bacterium stands out, the strongest first, and which of
    them may be one."""

    x: Int64[np.ndarray, " spot"]
    y: Int64[np.ndarray, " spot"]
    clear: Bool[np.ndarray, " spot"]

    @classmethod
    def of(cls, background: Background, noise: float) -> Spots:
        """Those of `background`; noise: what a deviation must exceed, in grey levels."""
        median = background.median
        band = cv2.GaussianBlur(median, (0, 0), 1.2) - cv2.GaussianBlur(median, (0, 0), 6)
        height = np.abs(band)
        # A bright spot, cut, does not count as its own surroundings.
        cut = np.minimum(height, 8 * float(np.median(height)) + 1e-6)
        around = np.sqrt(cv2.GaussianBlur(cut * cut, (0, 0), 12))
        peak = cv2.dilate(height, np.ones((7, 7), np.uint8)) == height
        y, x = np.nonzero(peak & (height > np.maximum(CONTRAST * noise, CLEARNESS * around)))
        strongest = np.argsort(-height[y, x], kind="stable")[:MOST]
        x, y = x[strongest], y[strongest]
        clear = height[y, x] > np.maximum(CLEAR * around, STEADY * background.spread)[y, x]
        return cls(x, y, clear)

    def samples(
        self,
        background: Background,
        film: Film,
        motion: FilmMotion,
        frames: range,
        alive: Callable[[], None] = lambda: None,
    ) -> list[Sample]:
        """Up to `SAMPLES` of them, in the order of their frames; none where there are no spots.

        Args:
            background: the spots' own.
            film, motion: frames as the camera took them, and how the scene stands in them.
            frames: consecutive ones of the film, those the background is made of.
            alive: called for each frame that is read.
        """
        samples = []
        for i in motion.sampled(frames, SAMPLES) if len(self.x) else ():
            alive()
            place = np.add(split_drift(motion.drift[i])[0], background.origin)
            samples.append(self.patches(aligned_frame(film, motion, i), (int(place[0]), int(place[1]))))
        return samples

    def patches(self, image: Float32[np.ndarray, "h w"], place: tuple[int, int] = (0, 0)) -> Sample:
        """What is around each spot in an image in which the background's corner lies at `place` (x, y), and whether the
        image shows all of it."""
        h, w = image.shape
        x, y = self.x + place[0], self.y + place[1]
        whole = (x >= REACH_PX) & (x < w - REACH_PX) & (y >= REACH_PX) & (y < h - REACH_PX)
        rows, columns = np.clip(y[:, None] + _ACROSS, 0, h - 1), np.clip(x[:, None] + _ACROSS, 0, w - 1)
        return image[rows[:, :, None], columns[:, None, :]], whole

    def near(self) -> Bool[np.ndarray, "spot spot"]:
        """Which may be of the same bacterium; each is near itself."""
        places = np.stack([self.x, self.y])
        near: np.ndarray = (np.abs(places[:, :, None] - places[:, None, :]) < SEPARATE_PX).all(axis=0)
        return near

    def strongest(self) -> Bool[np.ndarray, " spot"]:
        """Which have no stronger one near: the halo of a bacterium is a spot, too."""
        return ~np.asarray(np.tril(self.near(), -1).any(axis=1))

    def filled(self, background: Background, which: Bool[np.ndarray, " spot"]) -> Background:
        """`background` with the mean of what surrounds it in the median's place of each of these; the same object where
        there are none."""
        if not which.any():
            return background
        median = background.median
        # Places that no frame shows have no spread; nor has a film without noise, where these count all the same.
        free = np.where(background.spread > 0, np.float32(1), np.float32(1e-3))
        for centre in zip(self.x[which].tolist(), self.y[which].tolist(), strict=True):
            cv2.circle(free, centre, REACH_PX, 0.0, -1)
        around = cv2.GaussianBlur(median * free, (0, 0), 5) / np.maximum(cv2.GaussianBlur(free, (0, 0), 5), 1e-6)
        kept = cv2.GaussianBlur((free > 0).astype(np.float32), (0, 0), 1)
        return replace(background, median=np.asarray(median * kept + around * (1 - kept), np.float32))

    def replaced(
        self,
        background: Background,
        which: Bool[np.ndarray, " spot"],
        by: Float32[np.ndarray, "chosen edge edge"],
    ) -> Background:
        """`background` with other patches in the median's place of each of these, blended in at their rims."""
        disc = (RADIUS_PX < REACH_PX).astype(np.float32)
        share = cv2.GaussianBlur(disc, (0, 0), 1, borderType=cv2.BORDER_CONSTANT)
        # The frames show all of a patch, so the background does.
        median = background.median.copy()
        for x, y, patch in zip(self.x[which].tolist(), self.y[which].tolist(), by, strict=True):
            place = median[y - REACH_PX : y + REACH_PX + 1, x - REACH_PX : x + REACH_PX + 1]
            place += share * (patch - place)
        return replace(background, median=median)


def gaussian(width_px: float) -> Float32[np.ndarray, "edge edge"]:
    """Weights of a patch's pixels, 1 at its centre; width_px: their sigma."""
    squared = np.square(_ACROSS)
    weights: np.ndarray = np.exp(-(squared[:, None] + squared) / (2 * width_px**2), dtype=np.float32)
    return weights
