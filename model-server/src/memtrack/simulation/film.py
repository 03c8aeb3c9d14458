# SPDX-License-Identifier: GPL-3.0-or-later
"""One simulated film: scene, drift, bacteria, clutter, lamp and camera put together, and what is true of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import cv2
import numpy as np
from jaxtyping import Float32, Float64, Shaped

from memtrack.film import ArrayFilm, Calibration
from memtrack.motility import motility_of
from memtrack.resampling import read_shifted
from memtrack.simulation import scenes
from memtrack.simulation.optics import Look, apparent_centre, draw
from memtrack.simulation.swimming import Gait, Path, World, peak_diffusivity, swim
from memtrack.tracks import TrackTable

BOX_PX = 30.0
VISIBLE = 5.5
"""Smallest contrast of a bacterium with its own temporal median, summed over its pixels in units of the noise, at which
its box counts as truth; below it the row is marked as ignored, neither right nor wrong to find."""
RIM_PX = 8.0
"""How far outside the field a bacterium's centre may lie and still show enough to be found, so that it is ignored."""


@dataclass(frozen=True, slots=True)
class Recipe:
    """All that describes a simulated film but its random numbers; lengths in pixels, grey levels of an 8-bit camera.

    looks: one a bacterium, in the order of `gaits`. texture: standard deviation of the scene. shading: relative height
    of the uneven light. flicker: relative standard deviation of the lamp, lamp_drift: its slow change over the film.
    drift_per_frame: mean (x, y). jitter: of the stage, per axis and frame. jump: one sudden move of the stage. wobble:
    reach of fibre movement. restless: slow change of the scene, as a share of it. clutter: moving blurred blobs, their
    contrast in grey levels and their flow in pixels a frame. shutter: share of a frame's time the camera sees.
    read_noise, shot_noise: sd in grey levels, the second at full scale. decoys: static rods that look like bacteria.
    jpeg: quality, 0 for none.
    """

    width: int = 320
    height: int = 320
    frames: int = 80
    scene: str = "mottled"
    scale: float = 1.0
    bits: int = 8
    pixel_size_um: float = 0.2475
    frame_interval_seconds: float = 1 / 60
    level: float = 117.0
    texture: float = 18.0
    shading: float = 0.2
    flicker: float = 0.0
    lamp_drift: float = 0.0
    drift_per_frame: tuple[float, float] = (0.0, 0.0)
    jitter: float = 0.0
    jump: float = 0.0
    wobble: float = 0.0
    restless: float = 0.0
    clutter: int = 0
    clutter_contrast: float = 5.0
    clutter_flow: float = 0.0
    shutter: float = 0.0
    read_noise: float = 3.0
    shot_noise: float = 3.0
    noise_blur: float = 0.0
    decoys: int = 6
    dust: float = 0.0
    jpeg: int = 0
    speed_um_s: float = 10.0
    depth_spread: float = 0.6
    gaits: tuple[Gait, ...] = ()
    looks: tuple[Look, ...] = ()
    decoy_looks: tuple[Look, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class SimulatedFilm:
    """A film, the truth of each bacterium in each frame it is in the field, and the drift of the scene (x, y)."""

    film: ArrayFilm
    truth: TrackTable
    drift: Float64[np.ndarray, "frame 2"]
    recipe: Recipe


def simulate(recipe: Recipe, seed: int) -> SimulatedFilm:
    """The film of `recipe`; the same seed gives the same film, byte for byte, on the same versions of the libraries."""
    rng = np.random.default_rng(seed)
    n = recipe.frames
    drift = np.cumsum(np.tile(recipe.drift_per_frame, (n, 1)) + rng.normal(0, 0.3 * recipe.jitter, (n, 2)), axis=0)
    drift = drift + rng.normal(0, recipe.jitter, (n, 2))
    if recipe.jump and n > 2:
        angle = rng.uniform(0, 2 * np.pi)
        drift[rng.integers(1, n) :] += recipe.jump * np.array([np.cos(angle), np.sin(angle)])
    drift -= drift[0]
    world = World(
        recipe.width,
        recipe.height,
        n,
        recipe.pixel_size_um,
        recipe.frame_interval_seconds,
        recipe.speed_um_s,
        recipe.depth_spread,
    )
    paths = [swim(gait, world, rng) for gait in recipe.gaits]
    layers = _bacteria(recipe, paths, drift, range(n))
    scene = _Scene(recipe, drift, rng)
    lamp = 1 + recipe.flicker * rng.standard_normal(n)
    lamp *= 1 + recipe.lamp_drift * np.sin(np.linspace(0, rng.uniform(1, 6), n) + rng.uniform(0, 6))
    frames = np.stack([_expose(recipe, scene.frame(i) + layers[i], lamp[i], rng) for i in range(n)])
    calibration = Calibration(recipe.pixel_size_um, recipe.frame_interval_seconds)
    truth = _truth(recipe, paths, drift, calibration)
    return SimulatedFilm(ArrayFilm(frames, calibration), truth, drift, recipe)


def _bacteria(
    recipe: Recipe, paths: list[Path], drift: np.ndarray, chosen: Sequence[int], pad: int = 0
) -> Float32[np.ndarray, "frame h w"]:
    """What bacteria add to each chosen frame, on a canvas with `pad` pixels more on each side."""
    layers = np.zeros((len(chosen), recipe.height + 2 * pad, recipe.width + 2 * pad), np.float32)
    for path, look in zip(paths, recipe.looks, strict=True):
        for layer, i in zip(layers, chosen, strict=True):
            _draw(layer, recipe, path, look, i, drift[i] + pad)
    return layers


def _draw(layer: np.ndarray, recipe: Recipe, path: Path, look: Look, i: int, offset: np.ndarray) -> None:
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


class _Scene:
    """The medium without bacteria, on a canvas large enough for the drift."""

    def __init__(self, recipe: Recipe, drift: np.ndarray, rng: np.random.Generator) -> None:
        self.recipe, self.drift = recipe, drift
        self.pad = int(np.ceil(np.abs(drift).max())) + 12
        h, w = recipe.height + 2 * self.pad, recipe.width + 2 * self.pad
        make = scenes.SCENES[recipe.scene]
        still = make(h, w, recipe.scale, rng) * np.float32(recipe.texture)
        if recipe.dust:
            still += scenes.dust(h, w, recipe.scale, int(h * w / 6000), rng) * np.float32(recipe.dust)
        for look in recipe.decoy_looks:
            place = rng.uniform(0, [w, h])
            draw(still, look, place[0], place[1], rng.uniform(0, 2 * np.pi), rng.normal(0, recipe.depth_spread))
        self.still = still
        self.other = make(h, w, recipe.scale, rng) * np.float32(recipe.texture) if recipe.restless else None
        y, x = np.mgrid[: recipe.height, : recipe.width].astype(np.float32)
        direction, bow = rng.uniform(0, 2 * np.pi), rng.uniform(-0.5, 0.5)
        across = (x / recipe.width - 0.5) * np.cos(direction) + (y / recipe.height - 0.5) * np.sin(direction)
        self.light = (1 + recipe.shading * (across + bow * across * across)).astype(np.float32)
        self._prepare_wobble(h, w, rng)
        self._prepare_clutter(rng)

    def _prepare_wobble(self, h: int, w: int, rng: np.random.Generator) -> None:
        recipe = self.recipe
        self.bend = np.stack([scenes.mottled(h, w, 6.0, rng) for _ in range(2)]) if recipe.wobble else None
        period = rng.uniform(0.3, 3.0) / recipe.frame_interval_seconds
        t = np.arange(recipe.frames)
        phase = 2 * np.pi * t / period + np.cumsum(rng.normal(0, 0.2, recipe.frames))
        self.amplitude = recipe.wobble * np.sin(phase) if recipe.wobble else np.zeros(recipe.frames)

    def _prepare_clutter(self, rng: np.random.Generator) -> None:
        recipe = self.recipe
        self.blobs = []
        for _ in range(recipe.clutter):
            start = rng.uniform(0, [recipe.width, recipe.height])
            walk = start + np.cumsum(rng.normal(0, rng.uniform(0.02, 0.5), (recipe.frames, 2)), axis=0)
            walk += np.outer(np.arange(recipe.frames), rng.normal(0, recipe.clutter_flow, 2))
            wide = float(rng.choice([rng.uniform(10, 22), rng.uniform(20, 45)]) * recipe.scale)
            contrast = float(rng.choice([-1, 1]) * rng.uniform(0.3, 1) * recipe.clutter_contrast)
            self.blobs.append((walk, Look(wide, wide, contrast, 0.0, wide, 0.0, 0.0, 0.0)))

    def frame(self, i: int) -> Float32[np.ndarray, "h w"]:
        recipe, pad = self.recipe, self.pad
        image = self.still
        if self.other is not None:
            turn = recipe.restless * i / recipe.frames
            image = np.float32(np.cos(turn)) * image + np.float32(np.sin(turn)) * self.other
        if self.bend is not None:
            y, x = np.mgrid[: image.shape[0], : image.shape[1]].astype(np.float32)
            a = np.float32(self.amplitude[i])
            image = np.asarray(
                cv2.remap(image, x + a * self.bend[0], y + a * self.bend[1], cv2.INTER_CUBIC), np.float32
            )
        whole = np.rint(-self.drift[i]).astype(int)
        rest = -self.drift[i] - whole
        top, left = pad + whole[1], pad + whole[0]
        # A rim of the resampling filter's width around the field, so that its edges are not made up.
        part = image[top - 4 : top + recipe.height + 4, left - 4 : left + recipe.width + 4]
        out = read_shifted(np.ascontiguousarray(part), rest[0], rest[1])[4:-4, 4:-4].copy()
        for walk, look in self.blobs:
            x_now, y_now = walk[i] + self.drift[i]
            draw(out, look, float(x_now), float(y_now), 0.0, 0.0)
        lit: np.ndarray = (out + np.float32(recipe.level)) * self.light
        return lit


def _expose(recipe: Recipe, light: Float32[np.ndarray, "h w"], lamp: float, rng: np.random.Generator) -> np.ndarray:
    """Camera: shot and read noise, then 8 or 16 bits (16: of 12 used, with an offset of 100)."""
    image = light * np.float32(lamp)
    variance = recipe.read_noise**2 + recipe.shot_noise**2 * np.clip(image, 0, None) / 255
    noise = rng.standard_normal(image.shape, np.float32)
    if recipe.noise_blur:
        smooth = cv2.GaussianBlur(noise, (0, 0), recipe.noise_blur)
        noise = np.asarray(smooth / max(float(smooth.std()), 1e-6), np.float32)
    image = image + noise * np.sqrt(variance)
    if recipe.bits == 16:
        return np.clip(np.rint(100 + image * 15), 0, 65535).astype(np.uint16)
    out = np.clip(np.rint(image), 0, 255).astype(np.uint8)
    if recipe.jpeg:
        packed = cv2.imencode(".jpg", out, [cv2.IMWRITE_JPEG_QUALITY, recipe.jpeg])[1]
        return np.asarray(cv2.imdecode(packed, cv2.IMREAD_GRAYSCALE), np.uint8)
    return out


def _truth(
    recipe: Recipe, paths: list[Path], drift: Float64[np.ndarray, "frame 2"], calibration: Calibration
) -> TrackTable:
    """A row for each bacterium and frame in the field; motility by the diffusivity of its own path, without drift.

    Ignored are those too faint, those that never move, which are part of the scene, and those whose centre lies
    outside by less than `RIM_PX`, of which a part still shows.
    """
    noise = float(np.hypot(recipe.read_noise, recipe.shot_noise * np.sqrt(recipe.level / 255)))
    noise = max(noise, 0.03 * recipe.texture, 0.3)
    strengths = _strengths(recipe, paths)
    edge = np.array([recipe.width, recipe.height]) - 0.5
    rows: list[tuple[int, int, float, float, int, bool]] = []
    for number, (path, look) in enumerate(zip(paths, recipe.looks, strict=True)):
        seen = path.xy + drift
        near = ((seen > -0.5 - RIM_PX) & (seen < edge + RIM_PX)).all(axis=1)
        inside = ((seen > -0.5) & (seen < edge)).all(axis=1)
        known = inside & (strengths[number] >= VISIBLE * noise) & (path.gait is not Gait.STUCK)
        diffusivity = peak_diffusivity(path.xy * recipe.pixel_size_um, recipe.frame_interval_seconds)
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


def _strengths(recipe: Recipe, paths: list[Path]) -> Float64[np.ndarray, "bacterium frame"]:
    """Root of the summed squares of each bacterium's contrast with the temporal median within about a core's length of
    its centre, in grey levels; told on a stage that stands still, where nothing is resampled."""
    pad, still_stage = round(RIM_PX), np.zeros((recipe.frames, 2))
    chosen = np.unique(np.linspace(0, recipe.frames - 1, 25).astype(int))
    median = np.median(_bacteria(recipe, paths, still_stage, [int(i) for i in chosen], pad), axis=0)
    out = np.zeros((len(paths), recipe.frames))
    for number, (path, look) in enumerate(zip(paths, recipe.looks, strict=True)):
        reach = max(3, round(0.6 * look.length))
        for i in range(recipe.frames):
            left, top = (int(v) - reach for v in np.rint(path.xy[i]))
            here = -_patch(median, left + pad, top + pad, 2 * reach + 1)
            _draw(here, recipe, path, look, i, np.array([-left, -top]))
            out[number, i] = np.sqrt(np.square(here).sum())
    return out


def _patch(image: Shaped[np.ndarray, "h w"], left: int, top: int, size: int) -> Float32[np.ndarray, "s s"]:
    out = np.zeros((size, size), np.float32)
    h, w = image.shape
    a, b, c, d = max(top, 0), min(top + size, h), max(left, 0), min(left + size, w)
    if a < b and c < d:
        out[a - top : b - top, c - left : d - left] = image[a:b, c:d]
    return out
