# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the scene of one image stands from that of another: one shift of the whole field, and how sure it is.

Iterated least squares on image gradients (Lucas and Kanade's equation), with pixels that do not fit, the moving cells,
weighted down, and the field cut into blocks whose estimates must agree.
"""

from __future__ import annotations

import functools
import math

import cv2
import numpy as np
from jaxtyping import Float32, Float64

from memtrack.resampling import read_shifted

Image = Float32[np.ndarray, "h w"]

MAX_BLOCKS = 8
MIN_EDGE = 24


class Reference:
    """A still image with its gradients."""

    def __init__(self, image: Image) -> None:
        self.image = image
        self.gx = cv2.Scharr(image, cv2.CV_32F, 1, 0, scale=1 / 32)
        self.gy = cv2.Scharr(image, cv2.CV_32F, 0, 1, scale=1 / 32)


Window = tuple[slice, slice]


def overlap(shape: tuple[int, ...], shift: np.ndarray) -> tuple[Window, Window]:
    """Windows of a still image and of one whose scene stands `shift` (x, y) whole pixels further that show the same."""
    dx, dy = (int(s) for s in shift)
    h, w = shape[:2]
    target = (slice(max(0, -dy), max(0, min(h, h - dy))), slice(max(0, -dx), max(0, min(w, w - dx))))
    source = (slice(max(0, dy), max(0, min(h, h + dy))), slice(max(0, dx), max(0, min(w, w + dx))))
    return target, source


def register(
    reference: Reference, image: Image, start: Float64[np.ndarray, " 2"], *, steps: int
) -> tuple[Float64[np.ndarray, " 2"], float]:
    """Shift (x, y) of `image`'s scene against `reference`'s, and the standard error its blocks imply, in pixels.

    Converges from a `start` within about 3 px. An infinite error: the images show nothing in common.
    """
    shift, error = np.asarray(start, np.float64), np.inf
    for _ in range(steps):
        whole = np.rint(shift).astype(int)
        target, source = overlap(reference.image.shape, whole)
        moved = read_shifted(image, *(shift - whole))[source]
        if min(moved.shape) < MIN_EDGE // 2:
            return np.asarray(start, np.float64), np.inf
        residual = reference.image[target] - moved
        change, error = _block_shift(residual, reference.gx[target], reference.gy[target])
        shift = shift + np.clip(change, -2, 2)
        if np.abs(change).max() < 0.01:
            break
    return shift, error


def likeness(reference: Reference, image: Image, shift: Float64[np.ndarray, " 2"]) -> float:
    """Correlation, in [-1, 1], of what both images show if the scene stands `shift` further in `image` than in
    `reference`; 0 where that is hardly anything. To the pixel, and every other one, which is enough to tell a scene."""
    target, source = overlap(reference.image.shape, np.rint(shift).astype(int))
    still, moved = reference.image[target][::2, ::2], image[source][::2, ::2]
    if min(moved.shape) < MIN_EDGE // 4:
        return 0.0
    still, moved = still - still.mean(), moved - moved.mean()
    norm = float(np.linalg.norm(still)) * float(np.linalg.norm(moved))
    return float(np.vdot(still, moved)) / norm if norm > 0 else 0.0


def typical_likeness(first: Image, second: Image) -> float:
    """Median over the blocks of the field of the correlation, in [-1, 1], of two band-passed images of one size: a few
    bright cells make whole images alike, but not most of their blocks."""
    shared, squared, others = (_block_sums(product) for product in (first * second, first * first, second * second))
    size = np.sqrt(squared * others)
    return float(np.median(np.divide(shared, size, out=np.zeros_like(size), where=size > 0)))


def _block_shift(residual: Image, gx: Image, gy: Image) -> tuple[Float64[np.ndarray, " 2"], float]:
    """One least-squares step: the shift most blocks agree on, and its standard error."""
    scale = 1.4826 * float(np.median(np.abs(residual[::3, ::3]))) + 1e-6
    weight = np.square(residual * np.float32(1 / (3 * scale)))
    weight += 1
    weight = 1 / np.square(weight)  # Geman and McClure's: what does not fit at all has no say at all
    gxw, gyw = gx * weight, gy * weight
    a, b, c = (_block_sums(product) for product in (gxw * gx, gxw * gy, gyw * gy))
    u, v = _block_sums(gxw * residual), _block_sums(gyw * residual)
    ridge = 0.02 * (a + c).mean() + 1e-9
    determinant = (a + ridge) * (c + ridge) - b * b
    shifts = np.stack([(c + ridge) * u - b * v, (a + ridge) * v - b * u], axis=1) / determinant[:, None]
    trust = np.minimum(a + c, np.median(a + c) + 1e-12)  # one bright cell must not outvote the scene
    total = float(trust.sum())
    if not 0 < total < math.inf:
        return np.zeros(2), np.inf  # nothing to tell a shift by
    trust /= total
    common = np.array([_weighted_median(shifts[:, axis], trust) for axis in range(2)])
    spread = max(_weighted_median(np.abs(shifts[:, axis] - common[axis]), trust) for axis in range(2))
    close = np.abs(shifts - common).max(axis=1) <= 2.5 * spread + 1e-9
    if not trust[close].any():
        return np.zeros(2), np.inf  # no block agrees along both axes, as where one robot moves on pure black
    mean = np.average(shifts[close], axis=0, weights=trust[close])
    effective = 1 / np.square(trust).sum()
    return mean, 1.4826 * spread / float(np.sqrt(effective))


def _block_sums(values: Image) -> Float64[np.ndarray, " blocks"]:
    """Sums over up to `MAX_BLOCKS` x `MAX_BLOCKS` blocks; as two matrix products, quicker than any resizing."""
    rows, columns = (_membership(edge) for edge in values.shape)
    sums: np.ndarray = (rows @ values @ columns.T).ravel().astype(np.float64)
    return sums


@functools.lru_cache(64)
def _membership(edge: int) -> Float32[np.ndarray, "blocks edge"]:
    blocks = max(1, min(MAX_BLOCKS, edge // (MIN_EDGE // 2)))
    owner = np.arange(edge) * blocks // edge
    member: np.ndarray = (owner[None] == np.arange(blocks)[:, None]).astype(np.float32)
    return member


def _weighted_median(values: Float64[np.ndarray, " n"], weights: Float64[np.ndarray, " n"]) -> float:
    order = np.argsort(values)
    return float(values[order][np.searchsorted(np.cumsum(weights[order]), 0.5 * weights.sum())])
