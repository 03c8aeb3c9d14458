# SPDX-License-Identifier: GPL-3.0-or-later
"""Families of simulated films: recipes drawn at random within what a kind of medium and microscope shows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from memtrack.simulation import variations
from memtrack.simulation.optics import Look
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait

REFERENCE_AREA = 660 * 492


def draw_recipe(family: str, rng: np.random.Generator, *, width: int, height: int, frames: int | None = None) -> Recipe:
    """A recipe of `family` at random.

    Args:
        family: a name of `FAMILIES`.
        rng: source of the random numbers.
        width, height: size of the field in pixels.
        frames: length of the film; None draws one, as the family has it.
    """
    length = int(np.exp(rng.uniform(np.log(30), np.log(160)))) if frames is None else frames
    recipe = FAMILIES[family](Recipe(width=width, height=height, frames=length), rng)
    return recipe if frames is None else replace(recipe, frames=frames)


def collagen(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """Gel with grain as large as the bacteria; 6 to 60 bacteria for 660 x 492 pixels, rim included; many rest."""
    scale = _scale(rng, 0.75, 1.35)
    scene = str(rng.choice(["mottled", "mottled", "cloudy", "fibrous", "rings"]))
    texture = float(rng.uniform(5, 26))
    recipe = replace(
        _camera(_stage(recipe, rng), rng),
        scene=scene,
        scale=scale,
        pixel_size_um=0.2475 / scale,
        frame_interval_seconds=float(rng.choice([1 / 60, 1 / 60, 1 / 30, 1 / 100])),
        texture=texture,
        speed_um_s=float(rng.uniform(4, 25)),
        depth_spread=float(rng.uniform(0.2, 1.4)),
        dust=float(rng.choice([0.0, rng.uniform(2, 12)])),
    )
    gaits = [Gait.SWIMMING, Gait.HOPPING, Gait.TRAPPED, Gait.BROWNIAN, Gait.STUCK]
    count = _count(recipe, np.exp(rng.uniform(np.log(6), np.log(60))), rng)
    weights = rng.dirichlet([2, 4, 2, 1.5, 0.7])
    return _populate(
        recipe, count, gaits, weights, _kind(rng), float(np.exp(rng.uniform(np.log(16), np.log(120)))), rng
    )


def water(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """Clear medium, faster swimmers, more of them (8 to 90, likewise), often at a coarser pixel size."""
    scale = _scale(rng, 0.5, 1.2)
    recipe = replace(
        _camera(_stage(recipe, rng), rng),
        scene=str(rng.choice(["clear", "clear", "mottled", "cloudy"])),
        scale=scale,
        pixel_size_um=0.2475 / scale,
        frame_interval_seconds=float(rng.choice([1 / 60, 1 / 30, 1 / 26.87, 1 / 15])),
        texture=float(rng.uniform(0.5, 6)),
        speed_um_s=float(rng.uniform(8, 35)),
        depth_spread=float(rng.uniform(0.2, 1.3)),
        dust=float(rng.choice([0.0, rng.uniform(2, 8)])),
    )
    if rng.random() < 0.12:  # dark field or fluorescence
        recipe = replace(recipe, level=float(rng.uniform(8, 40)), texture=float(rng.uniform(0.3, 2)), jpeg=0)
    gaits = [Gait.SWIMMING, Gait.BROWNIAN, Gait.STUCK, Gait.TRAPPED]
    count = _count(recipe, np.exp(rng.uniform(np.log(8), np.log(90))), rng)
    weights = rng.dirichlet([8, 1.5, 0.7, 0.7])
    return _populate(recipe, count, gaits, weights, _kind(rng), float(rng.uniform(10, 80)), rng)


def empty(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """No bacterium at all, in any medium; most of these drift or flicker."""
    base = collagen(recipe, rng) if rng.random() < 0.75 else water(recipe, rng)
    return replace(base, gaits=(), looks=(), jitter=max(base.jitter, float(rng.uniform(0, 0.2))))


def _held_out(scene: str) -> Callable[[Recipe, np.random.Generator], Recipe]:
    def family(recipe: Recipe, rng: np.random.Generator) -> Recipe:
        return replace(collagen(recipe, rng), scene=scene)

    family.__doc__ = f"Like collagen, in front of {scene}, which no training film shows."
    return family


def _varied(
    vary: Callable[[Recipe, np.random.Generator], Recipe], share_of_water: float
) -> Callable[[Recipe, np.random.Generator], Recipe]:
    def family(recipe: Recipe, rng: np.random.Generator) -> Recipe:
        medium = water if rng.random() < share_of_water else collagen
        return vary(medium(recipe, rng), rng)

    family.__doc__ = f"Collagen or water. {vary.__doc__}"
    return family


FAMILIES: dict[str, Callable[[Recipe, np.random.Generator], Recipe]] = {
    "collagen": collagen,
    "water": water,
    "empty": empty,
    "foam": _held_out("foam"),
    "granular": _held_out("granular"),
    "slow": _varied(variations.slow, 0.85),
    "tethered": _varied(variations.tethered, 0.7),
    "faint": _varied(variations.faint, 0.3),
    "specks": _varied(variations.specks, 0.75),
    "brief": _varied(variations.brief, 0.4),
    "crowded": _varied(variations.crowded, 0.7),
    "captioned": _varied(variations.captioned, 0.5),
    "passing": _varied(variations.passing, 0.5),
    "packed": _varied(variations.packed, 0.5),
    "subtracted": _varied(variations.subtracted, 0.5),
}


def _scale(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def _count(recipe: Recipe, per_reference_field: float, rng: np.random.Generator) -> int:
    """Bacteria for the field with its margin, of which only a part is in sight at a time."""
    area = (recipe.width + 48) * (recipe.height + 48)
    return int(rng.poisson(per_reference_field * area / REFERENCE_AREA))


def _stage(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    """What stage, lamp, medium and shutter do; each is absent from 40 % of the films or more, but for the shading."""

    def sometimes(share: float, low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high)))) if rng.random() < share else 0.0

    speed, direction = sometimes(0.5, 0.005, 0.15), rng.uniform(0, 2 * np.pi)
    return replace(
        recipe,
        drift_per_frame=(float(speed * np.cos(direction)), float(speed * np.sin(direction))),
        jitter=sometimes(0.4, 0.02, 0.4),
        jump=sometimes(0.05, 1, 20),
        flicker=sometimes(0.4, 0.002, 0.03),
        lamp_drift=sometimes(0.3, 0.005, 0.1),
        wobble=sometimes(0.4, 0.05, 0.7),
        restless=sometimes(0.45, 0.02, 0.5),
        shading=float(rng.uniform(0, 0.6)),
        clutter=int(rng.poisson(3)) if rng.random() < 0.5 else 0,
        clutter_contrast=float(rng.uniform(2, 20)),
        clutter_flow=sometimes(0.4, 0.02, 1.0),
        shutter=sometimes(0.6, 0.3, 1.0),
    )


def _camera(recipe: Recipe, rng: np.random.Generator) -> Recipe:
    total = float(np.exp(rng.uniform(np.log(0.8), np.log(6))))
    share = rng.uniform(0.1, 0.9)
    return replace(
        recipe,
        bits=int(rng.choice([8, 8, 8, 16])),
        level=float(rng.uniform(70, 170)),
        read_noise=float(total * np.sqrt(share)),
        shot_noise=float(1.5 * total * np.sqrt(1 - share)),
        noise_blur=float(rng.choice([0, 0, 0, 0.5, 0.8])),
        jpeg=int(rng.choice([0, 0, 0, 0, 0, 0, 70, 90])),
    )


def _kind(rng: np.random.Generator) -> str:
    return str(rng.choice(["bright", "dark", "both"]))


def _populate(
    recipe: Recipe,
    count: int,
    gaits: list[Gait],
    weights: np.ndarray,
    kind: str,
    contrast: float,
    rng: np.random.Generator,
) -> Recipe:
    """Bacteria and look-alikes; those of one film share optics and differ in size, contrast and sign."""
    s = recipe.scale
    halo = float(rng.choice([0.0, rng.uniform(0.05, 0.35)]))
    flip = float(rng.choice([0.0, 0.5, 1.0]))
    # Slight, or so strong that the dark side shows: in between a core only seems to lie beside its centre.
    relief = float(rng.choice([0.0, 0.0, 0.0, rng.uniform(0.05, 0.25), rng.uniform(1.5, 4)]))
    angle, ring = float(rng.uniform(0, 2 * np.pi)), float(rng.uniform(7, 13))
    length, width = float(rng.uniform(6, 11)), float(rng.uniform(3, 5))
    if rng.random() < 0.1:  # cocci, beads
        length = width = float(rng.uniform(3, 7))
    spread = float(rng.uniform(0.1, 0.7))

    def look() -> Look:
        sign = {"bright": 1.0, "dark": -1.0, "both": float(rng.choice([-1, 1]))}[kind]
        height = sign * contrast * float(rng.lognormal(0, spread))
        own = float(rng.uniform(0.8, 1.25))
        wide = max(1.8, width * s * float(rng.uniform(0.85, 1.15)))
        return Look(max(wide, length * s * own), wide, height, halo, ring * s * own, flip, relief, angle)

    lookalikes = int(rng.poisson(rng.choice([0, 6, 20]) * recipe.width * recipe.height / REFERENCE_AREA * 2))
    chosen = tuple(gaits[k] for k in rng.choice(len(gaits), count, p=weights))
    return replace(
        recipe,
        gaits=chosen,
        looks=tuple(look() for _ in chosen),
        decoy_looks=tuple(look() for _ in range(lookalikes)),
    )
