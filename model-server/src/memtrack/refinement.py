# SPDX-License-Identifier: GPL-3.0-or-later
"""The Centre Refiner: a second, small net looks at each box from close by, and tells where its bacterium's centre is.

The detector's maps have a place every four pixels, by way of features at half of the frame's size or less; what that
costs in exactness is won back where it matters, at the frame's own pixels around each box. Not a part of the paper.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Float32, Float64, UInt8

from memtrack.channels import NEUTRAL
from memtrack.detections import Detections
from memtrack.detector import Features

Crops = UInt8[np.ndarray, "n channel edge edge"]
Estimates = Float32[np.ndarray, "n 3"]

EDGE_PX = 24
"""Edge of a crop: a long bacterium with its halo. The pixel at `EDGE_PX // 2` is its centre."""
DETECTOR_ERROR_PX = 0.4
"""How far off the detector's centre is along x or y, in the mean of both estimates: 0.3 to 0.5 are as good."""
LEAST_SCORE = 0.15
"""Fainter boxes are neither learnt from nor moved: most are of no bacterium, and each takes time."""
UNREFINED_ERROR_PX = 2.5
"""How far off along x or y the centre of a box is that is not moved, root mean square, in simulated films."""
FURTHEST_PX = 4.0
"""A centre is not moved further along x or y: half the distance within which two boxes are of one bacterium."""


@runtime_checkable
class Refiner(Protocol):
    """Runs one model's refining net."""

    def estimates(self, crops: Crops) -> Estimates:
        """Where the bacterium's centre is, (x, y) in pixels from each crop's centre pixel, and the natural logarithm of
        the error to expect along x or y, in pixels."""
        ...


def refined(found: Detections, channels: Features, refiner: Refiner) -> Detections:
    """`found`, boxes moved to the mean of where detector and refiner see their centre, weighted by how exact they are,
    with the error to expect of each.

    Boxes that share a centre stay together; where none of them is scored `LEAST_SCORE`, they stay where they are.

    Args:
        found: boxes in pixels of the channels.
        channels: features of the frame they were found in.
        refiner: of the model that found them.
    """
    centres, owner = np.unique(found.centres, axis=0, return_inverse=True)
    owner = owner.ravel()
    best = np.zeros(len(centres), np.float32)
    np.maximum.at(best, owner, found.scores)
    moving = best >= LEAST_SCORE
    change = np.zeros_like(centres, np.float64)
    errors = np.full(len(centres), UNREFINED_ERROR_PX, np.float32)
    if moving.any():
        change[moving], errors[moving] = _change(centres[moving], channels, refiner)
    boxes = (found.boxes + np.tile(change[owner], 2)).astype(np.float32)
    return replace(found, boxes=boxes, errors=errors[owner])


def _change(
    centres: Float[np.ndarray, "n 2"], channels: Features, refiner: Refiner
) -> tuple[Float64[np.ndarray, "n 2"], Float64[np.ndarray, " n"]]:
    """How far to move each centre, and the error to expect of it then: measured, the refiner's own is about right."""
    estimates = refiner.estimates(crops_around(channels, centres, EDGE_PX)).astype(np.float64)
    # Far off the refiner is worse than the detector, whose net sees more of the surroundings.
    errors = np.exp(estimates[:, 2])
    weight = 1 / (1 + (errors[:, None] / DETECTOR_ERROR_PX) ** 2)
    change = weight * (np.rint(centres) + estimates[:, :2] - centres)
    height, width = channels[0].shape
    edge = np.array([width, height]) - 0.5
    inside: np.ndarray = (centres + change.clip(-FURTHEST_PX, FURTHEST_PX)).clip(-0.5, edge) - centres
    return inside, errors


def crops_around(channels: Features, centres: Float[np.ndarray, "n 2"], edge: int) -> Crops:
    """Crops of `edge` x `edge` pixels around the pixels next to `centres` (x, y); neutral outside the frame."""
    image = np.asarray(channels)  # in one piece: one copy for a crop, not one for each of its channels
    height, width = image.shape[1:]
    crops = np.full((len(centres), len(image), edge, edge), NEUTRAL, np.uint8)
    for crop, (x, y) in zip(crops, np.rint(centres).astype(int) - edge // 2, strict=True):
        rows, columns = slice(max(0, y), min(height, y + edge)), slice(max(0, x), min(width, x + edge))
        part = image[:, rows, columns]
        top, left = rows.start - y, columns.start - x
        crop[:, top : top + part.shape[1], left : left + part.shape[2]] = part
    return crops
