# SPDX-License-Identifier: GPL-3.0-or-later
"""Geometry of boxes `x_min y_min x_max y_max` in pixels; computed in float64."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from memtrack.neighbours import led_by_the_best

Boxes = Float[np.ndarray, "n 4"]


def square_boxes(centres: Float[np.ndarray, "n 2"], size: float) -> Float[np.ndarray, "n 4"]:
    """Squares of edge `size` around `centres` (x, y)."""
    return np.concatenate([centres - size / 2, centres + size / 2], axis=1)


def areas(boxes: Float[np.ndarray, "n 4"]) -> Float[np.ndarray, " n"]:
    """Area of each box; 0 for one turned inside out."""
    wide = np.maximum(boxes[:, 2] - boxes[:, 0], 0).astype(np.float64)
    high = np.maximum(boxes[:, 3] - boxes[:, 1], 0).astype(np.float64)
    area: np.ndarray = wide * high
    return area


def pairwise_iou(first: Float[np.ndarray, "n 4"], second: Float[np.ndarray, "m 4"]) -> Float[np.ndarray, "n m"]:
    """Intersection over union of every box of `first` with every box of `second`; 0 where both are empty."""
    a, b = first.astype(np.float64), second.astype(np.float64)
    # One axis at a time: many times as fast as products over an axis of two.
    overlap, high = (_shared(a[:, axis::2], b[:, axis::2]) for axis in (0, 1))
    overlap *= high
    union = areas(a)[:, None] + areas(b)[None, :] - overlap
    shares: np.ndarray = np.divide(overlap, union, out=np.zeros_like(overlap), where=union > 0)
    return shares


def _shared(first: Float[np.ndarray, "n 2"], second: Float[np.ndarray, "m 2"]) -> Float[np.ndarray, "n m"]:
    """Length of what every interval of `first` has in common with every one of `second`, by their ends."""
    length: np.ndarray = np.minimum(first[:, None, 1], second[None, :, 1])
    length -= np.maximum(first[:, None, 0], second[None, :, 0])
    return np.maximum(length, 0, out=length)


def non_maximum_suppression(
    boxes: Float[np.ndarray, "n 4"], scores: Float[np.ndarray, " n"], iou: float
) -> Int[np.ndarray, " kept"]:
    """Indices of the boxes that no better scored kept box overlaps by more than `iou`, best first.

    Boxes with equal scores keep their order (paper section "False Positive Pruner": IoU 0.7).
    """
    corners = boxes.astype(np.float64)
    tallest = float((corners[:, 3] - corners[:, 1]).max(initial=0))

    def overlap(rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        return pairwise_iou(corners[rows], corners[columns]) > iou

    best = [i for i, _ in led_by_the_best(scores, corners[:, 1], tallest, overlap)]
    return np.array(best, np.intp)
