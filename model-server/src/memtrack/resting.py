# SPDX-License-Identifier: GPL-3.0-or-later
"""Bacteria that rest all through a film, where the user asks for them: what stands out of the still scene just as far
as the bacteria of the same film that move.

The temporal median holds them, so they are taken out of it, and the nets see them as they see one that swims. Nothing
but its look tells such a bacterium from debris, so no film is searched for them unasked. Not a part of the paper.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np
from jaxtyping import Bool, Float, Float32

from memtrack.background import Background
from memtrack.channels import Image
from memtrack.detections import Detections
from memtrack.spots import Spots

FEWEST, LEAST_SHARE = 10, 0.1
"""Fewer boxes, in number or of all, that are dark, or that are bright, tell of no look: a dark bacterium's bright halo
now and then stands out most."""
USUAL = (0.05, 0.95)
"""Quantiles between which their heights are usual."""
MARGIN = 1.2
"""A bacterium that rests may stand out so many times less or more: those that move are now and then out of focus."""
NEAR_PX = 3
"""So far from its centre along x and y a bacterium stands out most."""


@dataclass(frozen=True, slots=True)
class Looks:
    """How far the bacteria of a film stand out of their surroundings: lowest and greatest `heights` (in units of the
    noise, negative where dark), a row for the dark ones and a row for the bright ones, NaN where the film has none."""

    heights: Float[np.ndarray, "2 2"]

    @classmethod
    def of(cls, sights: Iterable[tuple[Image, Detections]]) -> Looks | None:
        """Of bacteria that move; None where too few do.

        Args:
            sights: deviation of a frame from the background, in units of the noise, and what was found there.
        """
        each = [_heights(deviation, *np.rint(found.centres).astype(np.intp).T) for deviation, found in sights]
        heights = np.concatenate(each) if each else np.empty(0)
        usual = np.full((2, 2), np.nan)
        for row, of_sign in zip(usual, (heights[heights < 0], heights[heights > 0]), strict=True):
            if len(of_sign) >= max(FEWEST, LEAST_SHARE * len(heights)):
                row[:] = np.quantile(of_sign, USUAL)
        if np.isnan(usual).all():
            return None
        return cls(usual * [[MARGIN, 1 / MARGIN], [1 / MARGIN, MARGIN]])

    def fit(self, heights: Float[np.ndarray, " n"]) -> Bool[np.ndarray, " n"]:
        """Which heights are those of bacteria of this film."""
        low, high = self.heights.T[..., None]
        inside: np.ndarray = ((heights >= low) & (heights <= high)).any(axis=0)
        return inside


def without_resting(background: Background, noise: float, looks: Looks) -> tuple[Background, int]:
    """`background` with what surrounds them in the place of bacteria that rest, and how many these are.

    Args:
        noise: what a deviation must exceed, in grey levels.
        looks: of the film's bacteria that move.
    """
    spots = Spots.of(background, noise)
    single = spots.clear & spots.strongest()
    surroundings = spots.filled(background, single).median
    heights = _heights((background.median - surroundings) / np.float32(noise), spots.x, spots.y)
    resting = single & looks.fit(heights)
    return spots.filled(background, resting), int(resting.sum())


def _heights(deviation: Image, x: np.ndarray, y: np.ndarray) -> Float32[np.ndarray, " n"]:
    """What deviates most around each place, with its sign."""
    smooth = cv2.GaussianBlur(deviation, (0, 0), 1.2)
    window = np.ones((2 * NEAR_PX + 1,) * 2, np.uint8)
    height, width = smooth.shape
    at = np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)
    low, high = (extreme(smooth, window)[at] for extreme in (cv2.erode, cv2.dilate))
    heights: np.ndarray = np.where(-low > high, low, high)
    return heights
