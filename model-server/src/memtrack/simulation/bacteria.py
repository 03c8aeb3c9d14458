# SPDX-License-Identifier: GPL-3.0-or-later
"""What the bacteria of a simulated film add to its frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float32

from memtrack.simulation.optics import Look, draw
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Path


def bacteria(
    recipe: Recipe, paths: list[Path], drift: np.ndarray, chosen: Sequence[int], pad: int = 0
) -> Float32[np.ndarray, "frame h w"]:
    """What bacteria add to each chosen frame, on a canvas with `pad` pixels more on each side."""
    layers = np.zeros((len(chosen), recipe.height + 2 * pad, recipe.width + 2 * pad), np.float32)
    for path, look in zip(paths, recipe.looks, strict=True):
        for layer, i in zip(layers, chosen, strict=True):
            draw_bacterium(layer, recipe, path, look, i, drift[i] + pad)
    return layers


def draw_bacterium(layer: np.ndarray, recipe: Recipe, path: Path, look: Look, i: int, offset: np.ndarray) -> None:
    """Adds one bacterium as it is in frame `i`, moved by `offset`, smeared over the way it makes while the shutter is
    open."""
    x, y = path.xy[i] + offset
    smear = recipe.shutter * (path.xy[min(i + 1, len(path.xy) - 1)] - path.xy[i])
    if np.abs(smear).max() < 1:
        draw(layer, look, x, y, path.heading[i], path.depth[i])
        return
    part = replace(look, contrast=look.contrast / 3)
    for share in (-1 / 3, 0, 1 / 3):
        draw(layer, part, x + share * smear[0], y + share * smear[1], path.heading[i], path.depth[i])
