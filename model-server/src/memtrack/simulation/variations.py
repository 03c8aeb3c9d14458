# SPDX-License-Identifier: GPL-3.0-or-later
"""What makes a drawn film hard in one respect: each takes a recipe and returns it changed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from memtrack.simulation.optics import Look
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait


def slow(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """Most bacteria hardly leave their place, so that they are nearly part of the background."""
    gaits = [Gait.BROWNIAN, Gait.TRAPPED, Gait.SWIMMING, Gait.STUCK]
    chosen = rng.choice(len(gaits), len(recipe.gaits), p=[0.45, 0.35, 0.15, 0.05])
    return replace(recipe, gaits=tuple(gaits[k] for k in chosen))


def tethered(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """Half of the bacteria are held at one point, where they wiggle or spin, among others that are stuck or swim."""
    gaits = [Gait.TETHERED, Gait.SWIMMING, Gait.STUCK, Gait.TRAPPED, Gait.BROWNIAN]
    chosen = rng.choice(len(gaits), len(recipe.gaits), p=[0.5, 0.3, 0.1, 0.05, 0.05])
    return replace(recipe, gaits=tuple(gaits[k] for k in chosen))


def faint(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """Bacteria, and what looks like them, whose contrast is 1.2 to 5 times the camera's noise."""
    contrasts = [abs(look.contrast) for look in recipe.looks]
    if not contrasts:
        return recipe
    noise = float(np.hypot(recipe.read_noise, recipe.shot_noise * np.sqrt(recipe.level / 255)))
    wanted = noise * float(np.exp(rng.uniform(np.log(1.2), np.log(5))))
    factor = min(1.0, wanted / float(np.median(contrasts)))
    return replace(
        recipe,
        looks=tuple(replace(look, contrast=look.contrast * factor) for look in recipe.looks),
        decoy_looks=tuple(replace(look, contrast=look.contrast * factor) for look in recipe.decoy_looks),
    )


def specks(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """Few bacteria among many of their look-alikes, which tremble in front of little noise."""
    pool = [*recipe.looks, *recipe.decoy_looks]
    if not pool:
        return recipe
    few = int(rng.integers(0, min(6, len(recipe.looks)) + 1))
    quiet = float(np.exp(rng.uniform(np.log(0.1), np.log(0.6))))
    decoys = tuple(_like(pool[int(rng.integers(len(pool)))], rng) for _ in range(int(rng.integers(5, 25))))
    return replace(
        recipe,
        gaits=recipe.gaits[:few],
        looks=recipe.looks[:few],
        decoy_looks=decoys,
        wobble=float(rng.uniform(0.1, 0.8)),
        read_noise=recipe.read_noise * quiet,
        shot_noise=recipe.shot_noise * quiet,
    )


def brief(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """A film of 6 to 30 frames."""
    return replace(recipe, frames=int(rng.integers(6, 31)))


def crowded(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """One bacterium for every 500 to 4000 square pixels, which are 80 to 650 in 660 x 492 pixels."""
    if not recipe.looks:
        return recipe
    room = float(np.exp(rng.uniform(np.log(500), np.log(4000))))
    count = round((recipe.width + 48) * (recipe.height + 48) / room)
    chosen = rng.integers(len(recipe.looks), size=count)
    return replace(
        recipe,
        gaits=tuple(recipe.gaits[k] for k in chosen),
        looks=tuple(_like(recipe.looks[k], rng) for k in chosen),
    )


def captioned(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """A clock that runs and a scale bar are burnt into the frames."""
    return replace(recipe, caption=True)


def passing(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """One to four large bodies pass through the field, whose grain is mostly weaker than the bacteria."""
    contrasts = [abs(look.contrast) for look in (*recipe.looks, *recipe.decoy_looks)]
    usual = float(np.median(contrasts)) if contrasts else 30.0
    return replace(
        recipe,
        passing=int(rng.integers(1, 5)),
        passing_contrast=usual * float(rng.uniform(0.15, 1.0)),
        passing_speed=float(np.exp(rng.uniform(np.log(0.1), np.log(5)))),
    )


def packed(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """A film that was packed as MPEG-4."""
    return replace(recipe, video=True, bits=8, jpeg=0)


def subtracted(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """A film on a still stage whose mean or median was subtracted from every frame."""
    return replace(
        recipe, subtracted=True, drift_per_frame=(0.0, 0.0), jump=0.0, jitter=min(recipe.jitter, 0.05), bits=8, jpeg=0
    )


def _like(look: Look, rng: np.random.Generator) -> Look:
    return replace(look, contrast=look.contrast * float(rng.lognormal(0, 0.4)))
