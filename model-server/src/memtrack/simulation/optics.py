# SPDX-License-Identifier: GPL-3.0-or-later
"""What a microscope shows of a rod-shaped bacterium: core, halo and rings, in and out of focus, of either sign."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float32


@dataclass(frozen=True, slots=True)
class Look:
    """How one bacterium is imaged; lengths in pixels, contrast in grey levels (negative: darker than the medium).

    length, width: full width of the in-focus core at half of its height. halo: strength of the surrounding ring of the
    other sign (phase contrast), halo_radius where it is strongest. flip: how far defocus turns the core's sign (bright
    field: 1). relief, relief_angle: a bright and a dark side (oblique light).
    """

    length: float
    width: float
    contrast: float
    halo: float
    halo_radius: float
    flip: float
    relief: float
    relief_angle: float

    @property
    def reach(self) -> int:
        """Half the edge of the square outside which nothing is drawn, in pixels."""
        return int(np.ceil(self.length / 2 + 2.6 * self.halo_radius))


def draw(image: Float32[np.ndarray, "h w"], look: Look, x: float, y: float, heading: float, depth: float) -> None:
    """Adds one bacterium centred on (x, y) to `image`, in place; parts outside are cut off."""
    h, w = image.shape
    reach = look.reach
    left, top = max(0, int(x) - reach), max(0, int(y) - reach)
    right, bottom = min(w, int(x) + reach + 1), min(h, int(y) + reach + 1)
    if left >= right or top >= bottom:
        return
    px = np.arange(left, right, dtype=np.float32) - np.float32(x)
    py = (np.arange(top, bottom, dtype=np.float32) - np.float32(y))[:, None]
    image[top:bottom, left:right] += _pattern(look, px, py, heading, depth)


def apparent_centre(look: Look, heading: float, depth: float) -> tuple[float, float]:
    """Where a bacterium seems to be, (x, y) from its middle: the centroid of its squared core.

    Oblique light moves the bright side, which is what anyone marks, away from the middle of the cell.
    """
    if not look.relief:
        return 0.0, 0.0
    reach = int(np.ceil(look.length / 2 + 2 * look.width))
    axis = np.arange(-reach, reach + 1, dtype=np.float32)
    weight = np.square(_pattern(replace(look, halo=0.0), axis, axis[:, None], heading, depth))
    total = float(weight.sum()) + 1e-12
    return float((weight * axis).sum()) / total, float((weight * axis[:, None]).sum()) / total


def _pattern(look: Look, px: np.ndarray, py: np.ndarray, heading: float, depth: float) -> Float32[np.ndarray, "h w"]:
    half = max(0.0, (look.length - look.width) / 2)
    along = np.abs(px * np.float32(np.cos(heading)) + py * np.float32(np.sin(heading)))
    across = py * np.float32(np.cos(heading)) - px * np.float32(np.sin(heading))
    beyond = np.maximum(along - np.float32(half), 0)
    squared = beyond * beyond + across * across
    blur = 1 + 0.5 * depth * depth
    sigma = look.width / 2.355 * np.sqrt(blur)
    core = np.exp(squared * np.float32(-0.5 / sigma**2))
    # A blurred core spreads its light: its height falls, and past the focus it may turn over.
    height = look.contrast / blur**0.8 * np.cos(look.flip * np.clip(depth, -2.2, 2.2))
    height /= 1 + 0.6 * look.relief
    out = np.float32(height) * core
    if look.relief:
        side = px * np.float32(np.cos(look.relief_angle)) + py * np.float32(np.sin(look.relief_angle))
        out += np.float32(height * look.relief / sigma) * side * core
    if look.halo:
        distance = np.sqrt(squared)
        radius = look.halo_radius * np.sqrt(1 + 0.25 * depth * depth)
        ring = (distance - np.float32(radius)) / np.float32(0.38 * radius)
        out -= np.float32(look.contrast * look.halo / (1 + 0.25 * depth * depth)) * np.exp(-0.5 * ring * ring)
        second = (distance - np.float32(1.8 * radius)) / np.float32(0.3 * radius)
        strength = 0.35 * look.halo * min(1.0, abs(depth)) / (1 + 0.25 * depth * depth)
        out += np.float32(look.contrast * strength) * np.exp(-0.5 * second * second)
    return out
