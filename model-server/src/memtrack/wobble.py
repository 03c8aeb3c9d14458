# SPDX-License-Identifier: GPL-3.0-or-later
"""A medium that wobbles: how far each part of it stands aside in a frame, and the deviation without that.

Fibres that bend by a tenth of a pixel make the flanks of all grains deviate, much as faint bacteria do. The flow of
Lucas and Kanade (1981), from the median to the frame, tells such a bend from bacteria: tens of pixels share it.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from jaxtyping import Float32

from memtrack.channels import Image

REACH_PX = 16.0
"""Width (sigma) of the Gaussian window whose pixels share a displacement: many times a bacterium's area."""
COARSE = 8
"""Windows are averaged at this fraction of the size, of products made at half of it: grain is coarser than that."""
STEEPEST = 2.0
"""Slopes count up to this many times their typical size, or one bacterium in the median outweighs its window."""
CLIPPED = 4.0
"""Deviations count up to this, in units of the noise, for the same reason."""
CLEAR = 1.5
"""Displacements must be so many times larger than by chance, all over the field, for the medium to wobble at all. Below
that, a bacterium that moves to and fro would be taken for a bend of its own window."""

Coarse = Float32[np.ndarray, "_ _"]
Products = Float32[np.ndarray, "3 _ _"]
"""Of xx, xy and yy."""


@dataclass(frozen=True, slots=True)
class Slopes:
    """Slopes of a background along x and y, in units of the noise a pixel, and what displacements need of them.

    weighted: slopes times the weight of their pixel; halves: these at half the size. power: windows' means of weighted
    times unweighted slopes. chance: of weighted slopes squared, to which the covariance of what the noise adds is
    proportional.
    """

    slopes: tuple[Image, Image]
    weighted: tuple[Image, Image]
    halves: tuple[Coarse, Coarse]
    power: Products
    chance: Products

    @classmethod
    def of(cls, median: Image, noise: float) -> Slopes:
        """Slopes of a film's median, both in grey levels."""
        smooth = cv2.GaussianBlur(median, (0, 0), 0.7) * np.float32(1 / noise)
        x, y = cv2.Sobel(smooth, cv2.CV_32F, 1, 0, scale=1 / 8), cv2.Sobel(smooth, cv2.CV_32F, 0, 1, scale=1 / 8)
        squared = x * x + y * y
        # The median of a squared slope is 0.69 times its mean, where slopes are normally distributed.
        steepest = np.float32(STEEPEST**2 / 0.69 * np.median(squared) + 1e-6)
        weight = np.minimum(steepest / (squared + np.float32(1e-9)), 1)
        u, v = x * weight, y * weight
        p, q, r, s = (_half(image) for image in (x, y, u, v))
        power = np.stack([_windowed(product) for product in (r * p, r * q, s * q)])
        chance = np.stack([_windowed(product) for product in (r * r, r * s, s * s)])
        return cls((x, y), (u, v), (r, s), power, chance)

    def seen(self, rows: slice, columns: slice) -> Slopes:
        """Of a part of the background."""
        (x, y), (u, v) = self.slopes, (image[rows, columns] for image in self.weighted)
        h, w = (max(1, (s.stop - s.start) // COARSE) for s in (rows, columns))
        # A window is so much wider than a coarse pixel that the part need not begin on one.
        top, left = (
            min(round(s.start / COARSE), whole - own)
            for s, whole, own in zip((rows, columns), self.power.shape[1:], (h, w), strict=True)
        )
        coarse = np.s_[:, top : top + h, left : left + w]
        return Slopes(
            (x[rows, columns], y[rows, columns]),
            (u, v),
            (_half(u), _half(v)),
            self.power[coarse],
            self.chance[coarse],
        )


def take_out_wobble(deviation: Image, background: Slopes) -> None:
    """Takes out of `deviation`, in units of the noise, what displacements of the medium explain; a film whose medium
    stands still keeps it as it is.

    How large displacements are by chance is told from the frame itself, turned by 180 degrees: its noise is the same,
    and nothing in it belongs to the slopes it then meets. The part of a displacement that chance explains stays.
    """
    (x, y), (a, b, c) = background.slopes, background.power
    small = _half(np.clip(deviation, -CLIPPED, CLIPPED))
    u, v = background.halves
    along_x, along_y = _windowed(u * small), _windowed(v * small)
    turned = small[::-1, ::-1]
    by_chance = _significance(background, _windowed(u * turned), _windowed(v * turned))
    clearness = _significance(background, along_x, along_y) / max(by_chance, 1e-12)
    if clearness <= CLEAR:
        return
    share = np.float32(1 - 1 / clearness)
    flat = np.float32(1e-4) * (a + c).mean() + np.float32(1e-12)
    a, c = a + flat, c + flat
    scale = share / (a * c - b * b)
    size = deviation.shape[::-1]
    right, down = (cv2.resize(s * scale, size) for s in (c * along_x - b * along_y, a * along_y - b * along_x))
    for slope, moved in ((x, right), (y, down)):
        moved *= slope
        deviation -= moved


def _significance(background: Slopes, along_x: Coarse, along_y: Coarse) -> float:
    """Squared length of what lies along the slopes, in units of what noise adds, at a typical place."""
    a, b, c = background.chance
    squared = c * along_x * along_x - 2 * b * along_x * along_y + a * along_y * along_y
    return float(np.median(squared / (a * c - b * b + np.float32(1e-12))))


def _half(image: Image) -> Coarse:
    return _smaller(image, 2)


def _windowed(product: Coarse) -> Coarse:
    return np.asarray(cv2.GaussianBlur(_smaller(product, COARSE // 2), (0, 0), REACH_PX / COARSE))


def _smaller(image: np.ndarray, times: int) -> Coarse:
    h, w = image.shape
    return np.asarray(cv2.resize(image, (max(1, w // times), max(1, h // times)), interpolation=cv2.INTER_AREA))
