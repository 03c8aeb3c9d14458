# SPDX-License-Identifier: GPL-3.0-or-later
"""Bacteria held in one place, where they wiggle: the temporal median shows them, so they are taken out of it.

A bacterium tethered to the glass, or one that trembles in a pore, hardly deviates from a median that holds it. Debris
is told from it by how it moves: not at all, or in the rhythms of the medium, which shakes alike all that lies in one
layer of it. So one that is alone is left where it is, and where all of them wiggle more is asked of each.

The numbers were chosen on simulated films (docs/experiments.md, "Tethered bacteria").
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from jaxtyping import Bool, Float, Float32

from memtrack.background import Background
from memtrack.spots import Sample, Spots, gaussian

LEAST_STEPS = 6
"""Fewer do not tell how far a spot typically moves."""
WIDTH_PX = 4.0
"""Width (sigma) of the Gaussian weights of the patch around a spot."""
LOUDEST = 20.0
"""Steps count up to this many times their error: a swimmer that passes moves a spot much further."""
RHYTHMS = 2
"""Courses in time that spots may share: a gel's layers do not move alike."""
OWN_SHARE = 0.75
"""Of a spot's typical step, what is left without the common rhythms."""
SIGNIFICANT, QUIET = 2.5, 4.0
"""A spot's typical step, in errors, must be so many times that of the film's quieter spots, their lower quartile, which
counts as 1 at least and as `QUIET` at most."""
FEWEST_OTHERS = 2
"""Spots apart from one that tell the rhythms it may share: with the stage, where its motion could not be measured."""
ALIKE = 0.15
"""Least share of what changes around a spot, but for the noise, that its steps explain: digits of a clock, and debris
in a packed video, change without a move."""
LEAST_STEP_PX = 0.11
"""Smaller steps are left alone: what stands so still is not told from a residue of the stage's motion."""


@dataclass(frozen=True, slots=True)
class _Moves:
    """How each spot moves from one sample to the next.

    steps: in pixels, NaN where it is not seen. error: standard deviation that the noise adds to them. explained: share
    of the typical change around the spot, less the noise's, that its steps account for.
    """

    steps: Float[np.ndarray, "spot axis step"]
    error: Float[np.ndarray, "spot axis"]
    explained: Float[np.ndarray, " spot"]


def without_tethered(background: Background, spots: Spots, samples: list[Sample], noise: float) -> Background:
    """`background` with what surrounds them in the place of bacteria that wiggle; the same object if there are none.

    Args:
        spots: of the background.
        samples: what is around them in frames of the film, see `Spots.samples`.
        noise: what a deviation must exceed, in grey levels.
    """
    if not spots.clear.any():
        return background
    moves = _moves(spots, samples, background.median, noise)
    # The halo of a bacterium moves with it, that of debris beside it does not: only the strongest spot is asked.
    return spots.filled(background, spots.clear & _moves_by_itself(spots, moves) & spots.strongest())


def _moves(spots: Spots, samples: list[Sample], median: Float32[np.ndarray, "h w"], noise: float) -> _Moves:
    """Steps from sample to sample, by the slopes of the median (Lucas and Kanade, 1981)."""
    smooth = cv2.GaussianBlur(median, (0, 0), 0.7)
    slopes = [spots.patches(cv2.Sobel(smooth, cv2.CV_32F, *axis, scale=1 / 8))[0] for axis in ((1, 0), (0, 1))]
    slope = np.stack(slopes, axis=1).reshape(len(spots.x), 2, -1)
    weight = gaussian(WIDTH_PX).ravel()
    weighted = slope * weight
    power = weighted @ slope.transpose(0, 2, 1)
    # A long bacterium has no slope along its axis.
    power += (0.05 * np.trace(power, axis1=1, axis2=2)[:, None, None] + 1e-9) * np.eye(2)
    solved = np.linalg.solve(power, weighted)

    steps, changes = [], []
    for (before, known), (now, still_known) in pairwise(samples):
        change = (before - now).reshape(len(spots.x), -1)
        change -= (change @ weight / weight.sum())[:, None]
        step = np.einsum("sap,sp->sa", solved, change)
        rest = change - (step[:, :, None] * slope).sum(axis=1)
        seen = (known & still_known)[:, None]
        steps.append(np.where(seen, step, np.nan))
        changes.append(np.where(seen, np.stack([np.square(d) @ weight for d in (change, rest)], axis=1), np.nan))
    if not steps:
        return _Moves(np.empty((len(spots.x), 2, 0)), np.ones((len(spots.x), 2)), np.zeros(len(spots.x)))
    error = np.sqrt(2 * np.square(solved).sum(axis=2)) * noise
    total, unexplained = _median(np.stack(changes, axis=2))[:, :, 0].T
    but_noise = np.maximum(total - 2 * noise**2 * weight.sum(), 0.2 * total)
    return _Moves(
        np.stack(steps, axis=2), np.maximum(error, 1e-9), (total - unexplained) / np.maximum(but_noise, 1e-12)
    )


def _moves_by_itself(spots: Spots, moves: _Moves) -> Bool[np.ndarray, " spot"]:
    """Which spots move, and in no rhythms that others have too."""
    seen = ~np.isnan(moves.steps[:, 0])
    told = (seen.sum(axis=1) >= LEAST_STEPS) & ((~spots.near()).sum(axis=1) >= FEWEST_OTHERS)
    if not told.any():
        return told
    rows = np.clip(np.nan_to_num(moves.steps / moves.error[:, :, None]), -LOUDEST, LOUDEST)
    rhythms = _rhythms_of_others(spots, rows)
    rest = rows - rows @ rhythms @ rhythms.transpose(0, 2, 1)
    # By chance rhythms take their share of any course in time.
    rest *= np.sqrt(rows.shape[2] / (rows.shape[2] - RHYTHMS))
    own, with_rhythms = _typical(rest, seen), _typical(rows, seen)
    quiet = np.clip(np.quantile(own[told], 0.25), 1, QUIET)
    far = own * np.sqrt(np.square(moves.error).mean(axis=1)) > LEAST_STEP_PX
    by_itself = (own > SIGNIFICANT * quiet) & (own > OWN_SHARE * with_rhythms)
    return told & far & by_itself & (moves.explained > ALIKE)


def _rhythms_of_others(
    spots: Spots, rows: Float[np.ndarray, "spot axis step"]
) -> Float[np.ndarray, "spot step rhythm"]:
    """For each spot the courses in time, orthonormal, that explain most of the steps of those apart from it."""
    count = rows.shape[2]
    length = np.linalg.norm(rows, axis=2, keepdims=True)
    even = rows * np.minimum(1, 3 * np.sqrt(count) / (length + 1e-9))  # so that no single spot is a rhythm
    products = even.transpose(0, 2, 1) @ even
    own = (spots.near().astype(float) @ products.reshape(len(products), -1)).reshape(products.shape)
    courses: np.ndarray = np.linalg.eigh(products.sum(axis=0) - own)[1][:, :, -RHYTHMS:]
    return courses


def _typical(rows: Float[np.ndarray, "spot axis step"], seen: Bool[np.ndarray, "spot step"]) -> np.ndarray:
    """Standard deviation of both axes, told from medians, since others pass now and then; without a steady creep."""
    known = np.where(seen[:, None], rows, np.nan)
    known = np.abs(known - _median(known))
    return np.sqrt(np.square(1.4826 * _median(known)[:, :, 0]).mean(axis=1))


def _median(known: Float[np.ndarray, "spot axis step"]) -> Float[np.ndarray, "spot axis 1"]:
    """Of what is not NaN; 0 where nothing is."""
    known = np.where(np.isnan(known).all(axis=2, keepdims=True), 0, known)
    return np.asarray(np.nanmedian(known, axis=2, keepdims=True))
