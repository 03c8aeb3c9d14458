# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies much larger than a bacterium that pass through the field, as flakes of debris do; they are no cells."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from jaxtyping import Float32, Float64

from memtrack.simulation import scenes


@dataclass(frozen=True, slots=True)
class Body:
    """Grey levels that a body adds around its centre, and that centre (x, y) in each frame, in the scene."""

    patch: Float32[np.ndarray, "edge edge"]
    path: Float64[np.ndarray, "frame 2"]

    def draw(self, image: Float32[np.ndarray, "h w"], frame: int, drift: Float64[np.ndarray, " 2"]) -> None:
        """Adds the body to `image`, in place; parts outside are cut off."""
        left, top = self.path[frame] + drift - (len(self.patch) - 1) / 2
        place = np.array([[1, 0, left], [0, 1, top]], np.float32)
        image += cv2.warpAffine(self.patch, place, image.shape[::-1])


def passing_body(
    width: int, height: int, frames: int, scale: float, contrast: float, speed: float, rng: np.random.Generator
) -> Body:
    """A body of 24 to 100 px at `scale` 1, of one grey level and grain, that comes near the field's middle.

    Args:
        width, height, frames: of the film.
        scale: size of the medium's grain.
        contrast: standard deviation of its grain, grey levels.
        speed: pixels a frame.
        rng: source of the random numbers.
    """
    radius = scale * float(rng.uniform(12, 50))
    edge = 2 * int(np.ceil(1.3 * radius)) + 1
    y, x = np.mgrid[:edge, :edge].astype(np.float32) - edge // 2
    angle = np.arctan2(y, x)
    bumps = sum(float(rng.normal(0, 0.08)) * np.cos(k * angle + float(rng.uniform(0, 6.3))) for k in (2, 3, 5))
    inside = (np.hypot(x, y) < radius * (1 + np.clip(bumps, -0.25, 0.25))).astype(np.float32)
    inside = np.asarray(cv2.GaussianBlur(inside, (0, 0), scale * float(rng.uniform(0.8, 4))), np.float32)
    grain = scenes.mottled(edge, edge, scale * float(rng.uniform(0.4, 1.2)), rng)
    patch = inside * np.float32(contrast) * (grain + np.float32(rng.normal(0, 1)))
    direction = rng.uniform(0, 2 * np.pi)
    step = speed * np.array([np.cos(direction), np.sin(direction)])
    middle = rng.uniform(0.2, 0.8, 2) * [width, height]
    walk = np.cumsum(rng.normal(0, 0.1 + 0.1 * speed, (frames, 2)), axis=0)
    return Body(patch.astype(np.float32), middle + np.outer(np.arange(frames) - rng.uniform(0, frames), step) + walk)
