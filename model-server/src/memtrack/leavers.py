# SPDX-License-Identifier: GPL-3.0-or-later
"""Bacteria and robots that rest in one place for most of a film, and are elsewhere for the rest of it.

The temporal median holds them: they are missed while they rest, and leave a ghost when they go. So what is seen there
without them takes their place in the median. Debris does not go. Not a part of the paper.

The numbers were chosen on simulated films (docs/experiments.md, "Bacteria that come or go").
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float32

from memtrack.background import Background
from memtrack.spots import RADIUS_PX, Sample, Spots, gaussian

WIDTH_PX = 3.0
"""Width (sigma) of the Gaussian weights of the patch around a spot."""
GONE, THERE = 0.35, 0.65
"""A spot is not there where its patch holds less than this share of what the median has of it, and there where it holds
more than the second."""
LEAST_PART, LEAST_TOLD, MOST_TURNS = 0.1, 0.85, 2
"""It is there, and is not there, in this share of the samples or more each, is one or the other in most of them, and
goes and comes only so often: what others pass over, or what wobbles, is no leaver."""
INNER_PX, OUTER_PX, MOST_OUTSIDE = 2.5, 6.0, 0.3
"""What comes and goes is so much fainter beyond `OUTER_PX` than within `INNER_PX` of the centre: larger bodies, whose
rims and marks are spots, come and go, too."""
LEAST_SAMPLES = 12
MOST_LEAVERS, MANY = 0.5, 8
"""Where of many spots more than this share leave, the scene has changed."""


def without_leavers(background: Background, spots: Spots, samples: list[Sample]) -> tuple[Background, Spots]:
    """`background` with what is behind them in the place of spots that leave, the same object if none does; and the
    spots, of which those are clear no more.

    Args:
        spots: of the background.
        samples: what is around them in frames of the film, see `Spots.samples`.
    """
    if len(samples) < LEAST_SAMPLES:
        return background, spots
    patches, seen = (np.stack(of_samples, axis=1) for of_samples in zip(*samples, strict=True))
    gone = _gone(spots.patches(background.median)[0], patches, seen)
    leaving = np.asarray(gone.any(axis=1))
    if not leaving.any() or (leaving.sum() >= MANY and leaving.mean() > MOST_LEAVERS):
        return background, spots
    behind = np.stack([np.median(patches[k, gone[k]], axis=0) for k in np.flatnonzero(leaving)])
    return spots.replaced(background, leaving, behind), replace(spots, clear=spots.clear & ~leaving)


def _gone(
    usual: Float32[np.ndarray, "spot edge edge"],
    patches: Float32[np.ndarray, "spot sample edge edge"],
    seen: Bool[np.ndarray, "spot sample"],
) -> Bool[np.ndarray, "spot sample"]:
    """In which samples a spot that leaves is not there; in none where it does not leave."""
    weight = gaussian(WIDTH_PX)
    weight /= weight.sum()
    look = usual - np.einsum("sab,ab->s", usual, weight)[:, None, None]
    weighted = look * weight
    # The mean is rounded, which adds up where grey levels are as large as in films of 16 bits.
    weighted -= np.einsum("sab->s", weighted)[:, None, None] * weight
    power = np.einsum("sab,sab->s", weighted, look)
    share = np.einsum("snab,sab->sn", patches, weighted) / np.maximum(power, 1e-12)[:, None]
    gone = np.zeros(seen.shape, bool)
    for k, known in enumerate(seen):
        if known.sum() < LEAST_SAMPLES:
            continue
        course = _steadied(share[k, known])
        away, there = np.abs(course) < GONE, course > THERE
        turns = np.count_nonzero(np.diff(course < (GONE + THERE) / 2))
        both = min(away.mean(), there.mean()) >= LEAST_PART and (away | there).mean() >= LEAST_TOLD
        if both and turns <= MOST_TURNS and _is_small(patches[k, known], there, away):
            gone[k, known] = away
    return gone


def _steadied(course: Float32[np.ndarray, " n"]) -> Float32[np.ndarray, " n"]:
    """Medians of three, so that what passes for a sample does not count."""
    around = np.stack([np.r_[course[:1], course[:-1]], course, np.r_[course[1:], course[-1:]]])
    return np.asarray(np.median(around, axis=0), np.float32)


def _is_small(
    patches: Float32[np.ndarray, "sample edge edge"],
    there: Bool[np.ndarray, " sample"],
    away: Bool[np.ndarray, " sample"],
) -> bool:
    """Whether what comes and goes is as small as a bacterium."""
    power = np.square(np.median(patches[there], axis=0) - np.median(patches[away], axis=0))
    return bool(power[RADIUS_PX > OUTER_PX].mean() < MOST_OUTSIDE**2 * power[RADIUS_PX < INNER_PX].mean())
