# SPDX-License-Identifier: GPL-3.0-or-later
"""One simulated film: scene, drift, bacteria, clutter, lamp and camera put together, and what is true of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from jaxtyping import Float32, Float64

from memtrack.film import ArrayFilm, Calibration
from memtrack.resampling import read_shifted
from memtrack.simulation import scenes
from memtrack.simulation.bacteria import bacteria
from memtrack.simulation.captions import burn_in
from memtrack.simulation.optics import Look, draw
from memtrack.simulation.passing import passing_body
from memtrack.simulation.processing import through_video, without_background
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import World, swim
from memtrack.simulation.truth import truth_of
from memtrack.tracks import TrackTable


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
    layers = bacteria(recipe, paths, drift, range(n))
    scene = _Scene(recipe, drift, rng)
    lamp = 1 + recipe.flicker * rng.standard_normal(n)
    lamp *= 1 + recipe.lamp_drift * np.sin(np.linspace(0, rng.uniform(1, 6), n) + rng.uniform(0, 6))
    frames = np.stack([_expose(recipe, scene.frame(i) + layers[i], lamp[i], rng) for i in range(n)])
    if recipe.caption:
        burn_in(frames, recipe.frame_interval_seconds, rng)
    known = recipe
    if recipe.video:
        packed = through_video(frames)
        # What the packing changes is noise to an observer.
        change = float(np.std(packed.astype(np.float32) - frames))
        frames, known = packed, replace(recipe, read_noise=float(np.hypot(recipe.read_noise, change)))
    if recipe.subtracted:
        frames = without_background(frames, _sign(recipe), rng)
    calibration = Calibration(recipe.pixel_size_um, recipe.frame_interval_seconds)
    truth = truth_of(known, paths, drift, scene.still_medium, calibration)
    return SimulatedFilm(ArrayFilm(frames, calibration), truth, drift, recipe)


def _sign(recipe: Recipe) -> int:
    """1 where all bacteria are brighter than the medium at any depth, -1 where all are darker, else 0."""
    signs = {int(np.sign(look.contrast)) if not (look.flip or look.relief) else 0 for look in recipe.looks}
    return signs.pop() if len(signs) == 1 else 0


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
        self.bodies = [
            passing_body(
                recipe.width,
                recipe.height,
                recipe.frames,
                recipe.scale,
                recipe.passing_contrast * float(rng.lognormal(0, 0.4)),
                recipe.passing_speed * float(rng.lognormal(0, 0.4)),
                rng,
            )
            for _ in range(recipe.passing)
        ]

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
        image = self._medium(i)
        whole = np.rint(-self.drift[i]).astype(int)
        rest = -self.drift[i] - whole
        top, left = pad + whole[1], pad + whole[0]
        # A rim of the resampling filter's width around the field, so that its edges are not made up.
        part = image[top - 4 : top + recipe.height + 4, left - 4 : left + recipe.width + 4]
        out = read_shifted(np.ascontiguousarray(part), rest[0], rest[1])[4:-4, 4:-4].copy()
        for walk, look in self.blobs:
            x_now, y_now = walk[i] + self.drift[i]
            draw(out, look, float(x_now), float(y_now), 0.0, 0.0)
        for body in self.bodies:
            body.draw(out, i, self.drift[i])
        lit: np.ndarray = (out + np.float32(recipe.level)) * self.light
        return lit

    def still_medium(self, i: int) -> Float32[np.ndarray, "h w"]:
        """The medium as frame `i` would show it on a stage that stands still, evenly lit."""
        pad = self.pad
        return self._medium(i)[pad : pad + self.recipe.height, pad : pad + self.recipe.width]

    def _medium(self, i: int) -> Float32[np.ndarray, "h w"]:
        recipe = self.recipe
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
        return image


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
