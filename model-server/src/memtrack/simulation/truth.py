# SPDX-License-Identifier: GPL-3.0-or-later
"""What is true of a simulated film: where each bacterium is, and whether anyone could find it there."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
from jaxtyping import Float32, Float64

from memtrack.film import Calibration
from memtrack.motility import motility_of
from memtrack.simulation.bacteria import bacteria, draw_bacterium
from memtrack.simulation.optics import apparent_centre
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait, Path, path_diffusivity
from memtrack.tracks import TrackTable

Medium = Callable[[int], Float32[np.ndarray, "h w"]]

BOX_PX = 30.0
VISIBLE = 5.5
"""Smallest signal-to-noise ratio of a bacterium at which its box counts as truth; below it the row is marked as
ignored, neither right nor wrong to find."""
RIM_PX = 8.0
"""How far outside the field a bacterium's centre may lie and still show enough to be found, so that it is ignored."""
SAMPLES = 25
"""Frames that tell what stands still."""


def truth_of(
    recipe: Recipe,
    paths: list[Path],
    drift: Float64[np.ndarray, "frame 2"],
    medium: Medium,
    calibration: Calibration,
) -> TrackTable:
    """A row for each bacterium and frame in the field; motility by the diffusivity of its own path, without drift.

    Ignored are those too faint, those that never move, which are part of the scene, and those whose centre lies
    outside by less than `RIM_PX`, of which a part still shows.

    Args:
        recipe, paths, drift: of the film.
        medium: the scene without bacteria in a frame, on a stage that stands still.
        calibration: of the film.
    """
    ratios = _signal_to_noise(recipe, paths, medium)
    edge = np.array([recipe.width, recipe.height]) - 0.5
    rows: list[tuple[int, int, float, float, int, bool]] = []
    for number, (path, look) in enumerate(zip(paths, recipe.looks, strict=True)):
        seen = path.xy + drift
        near = ((seen > -0.5 - RIM_PX) & (seen < edge + RIM_PX)).all(axis=1)
        inside = ((seen > -0.5) & (seen < edge)).all(axis=1)
        ratio = ratios[number]
        if path.gait is Gait.TETHERED:  # it passes through its own median, and is there all the same
            ratio = np.full_like(ratio, np.sqrt(np.square(ratio).mean()))
        known = inside & (ratio >= VISIBLE) & (path.gait is not Gait.STUCK)
        diffusivity = path_diffusivity(path.xy * recipe.pixel_size_um, recipe.frame_interval_seconds)
        motility = int(motility_of(diffusivity))
        for i in np.flatnonzero(near):
            dx, dy = apparent_centre(look, path.heading[i], path.depth[i])
            x, y = float(seen[i, 0]) + dx, float(seen[i, 1]) + dy
            rows.append((int(i), number, x, y, motility, not known[i]))
    columns = list(zip(*rows, strict=True)) if rows else [()] * 6
    return TrackTable.of(
        columns[0],
        columns[1],
        columns[2],
        columns[3],
        width=BOX_PX,
        height=BOX_PX,
        motility=columns[4],
        ignored=columns[5],
        calibration=calibration,
    )


def _signal_to_noise(recipe: Recipe, paths: list[Path], medium: Medium) -> Float64[np.ndarray, "bacterium frame"]:
    """Of an observer who knows what each bacterium looks like (a matched filter) and has the film's temporal median.

    Signal: the bacterium's contrast with that median within about a core's length of its centre. Noise: that of the
    camera, smoothed as the camera smooths it, and what the medium itself changes at that place during the film. Told
    on a stage that stands still, where nothing is resampled.
    """
    chosen = [int(i) for i in np.unique(np.linspace(0, recipe.frames - 1, SAMPLES).astype(int))]
    pad = round(RIM_PX + 0.6 * max((look.length for look in recipe.looks), default=0)) + 1
    still_stage = np.zeros((recipe.frames, 2))
    median = np.median(bacteria(recipe, paths, still_stage, chosen, pad), axis=0)
    changes = _changes(recipe, medium, chosen, pad)
    camera = float(np.hypot(recipe.read_noise, recipe.shot_noise * np.sqrt(recipe.level / 255)))
    camera = max(camera, 0.03 * recipe.texture, 0.3)
    out = np.zeros((len(paths), recipe.frames))
    for number, (path, look) in enumerate(zip(paths, recipe.looks, strict=True)):
        reach = max(3, round(0.6 * look.length))
        for i in range(recipe.frames):
            left, top = (int(v) - reach for v in np.rint(path.xy[i]))
            rows, columns = (slice(v + pad, v + pad + 2 * reach + 1) for v in (top, left))
            if min(rows.start, columns.start) < 0 or rows.stop > median.shape[0] or columns.stop > median.shape[1]:
                continue  # further outside than the rim
            signal = -median[rows, columns]
            draw_bacterium(signal, recipe, path, look, i, np.array([-left, -top]))
            power = float(np.square(signal).sum())
            residues = np.tensordot(changes[:, rows, columns], signal, 2)
            noise = np.square(camera * _smoothed_norm(signal, recipe.noise_blur)) + np.square(residues).mean()
            out[number, i] = power / np.sqrt(noise + 1e-12)
    return out


def _changes(recipe: Recipe, medium: Medium, chosen: list[int], pad: int) -> Float32[np.ndarray, "sample h w"]:
    """The medium of the chosen frames less its temporal median, with nothing around it."""
    if not (recipe.wobble or recipe.restless):
        return np.zeros((1, recipe.height + 2 * pad, recipe.width + 2 * pad), np.float32)
    frames = np.stack([medium(i) for i in chosen])
    return np.pad(frames - np.median(frames, axis=0), ((0, 0), (pad, pad), (pad, pad)))


def _smoothed_norm(signal: Float32[np.ndarray, "s s"], blur: float) -> float:
    """Standard deviation of what white noise of unit deviation, smoothed by `blur` and brought back to unit deviation,
    adds to the product of a frame with `signal`."""
    if not blur:
        return float(np.linalg.norm(signal))
    padded = np.pad(signal, 4)
    impulse = np.zeros((9, 9), np.float32)
    impulse[4, 4] = 1
    smoothed, kernel = (cv2.GaussianBlur(image, (0, 0), blur) for image in (padded, impulse))
    return float(np.linalg.norm(smoothed) / np.linalg.norm(kernel))
