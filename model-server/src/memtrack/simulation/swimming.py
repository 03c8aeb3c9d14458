# SPDX-License-Identifier: GPL-3.0-or-later
"""How bacteria move: paths in pixels, with heading and depth, for each way of moving the paper and its media know."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float64


class Gait(enum.StrEnum):
    """Way of moving."""

    SWIMMING = "swimming"  # runs and tumbles, as in water
    HOPPING = "hopping"  # rests in a pore of the gel, then darts to the next
    TRAPPED = "trapped"  # jiggles and turns around one place
    BROWNIAN = "brownian"
    TETHERED = "tethered"  # held at one point of the glass or the gel, around which it wiggles or spins
    STUCK = "stuck"  # part of the scene


@dataclass(frozen=True, slots=True)
class Path:
    """One bacterium's centre (pixels), heading (radians) and depth (in depths of field, 0 in focus) in every frame."""

    gait: Gait
    xy: Float64[np.ndarray, "frame 2"]
    heading: Float64[np.ndarray, " frame"]
    depth: Float64[np.ndarray, " frame"]


@dataclass(frozen=True, slots=True)
class World:
    """What all bacteria of a film share: size of the field in pixels, frames, scale and typical speed."""

    width: int
    height: int
    frames: int
    pixel_size_um: float
    frame_interval_seconds: float
    speed_um_s: float
    depth_spread: float

    @property
    def margin(self) -> float:
        """How far outside the field bacteria live, in pixels."""
        return 24.0


def swim(gait: Gait, world: World, rng: np.random.Generator) -> Path:
    """A path that starts anywhere in the field or its margin; it may leave the field."""
    n, dt = world.frames, world.frame_interval_seconds
    low = np.full(2, -world.margin)
    high = np.array([world.width, world.height]) + world.margin
    start = rng.uniform(low, high)
    if gait is Gait.SWIMMING:  # it crosses the field around a frame drawn at random, not always the first
        steps, heading = _run_and_tumble(world, rng)
        xy = np.cumsum(steps, axis=0)
        xy = start + xy - xy[rng.integers(n)]
    elif gait is Gait.HOPPING:
        steps, heading = _hops(world, rng)
        xy = np.cumsum(steps, axis=0)
        xy = (
            start + xy - xy[rng.integers(n)] + _confined(n, dt, rng.uniform(0.02, 0.12), 0.1, rng) / world.pixel_size_um
        )
    elif gait is Gait.TRAPPED:
        reach, memory = rng.uniform(0.08, 0.6), rng.uniform(0.05, 0.6)
        xy = start + _confined(n, dt, reach, memory, rng) / world.pixel_size_um
        turning = rng.choice([0.0, 1.0, 6.0])
        heading = rng.uniform(0, 2 * np.pi) + np.cumsum(rng.normal(0, np.sqrt(turning * dt), n))
    elif gait is Gait.BROWNIAN:
        diffusivity = 10 ** rng.uniform(-1.2, -0.1)
        xy = start + np.cumsum(rng.normal(0, np.sqrt(2 * diffusivity * dt), (n, 2)), axis=0) / world.pixel_size_um
        heading = rng.uniform(0, 2 * np.pi) + np.cumsum(rng.normal(0, np.sqrt(0.5 * dt), n))
    elif gait is Gait.TETHERED:
        moves, heading = _around_its_tether(world, rng)
        xy = start + moves
    else:
        xy, heading = np.tile(start, (n, 1)), np.full(n, rng.uniform(0, 2 * np.pi))
    return Path(gait, xy, heading, _depth(gait, world, rng))


def _run_and_tumble(world: World, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Runs of about a second with slowly wandering heading, tumbles of a tenth (Berg & Brown 1972)."""
    n, dt = world.frames, world.frame_interval_seconds
    speed = world.speed_um_s * rng.lognormal(-0.08, 0.4)
    rate = rng.choice([0.0, 0.5, 1.0, 3.0])
    wander = np.sqrt(2 * rng.uniform(0.02, 0.6) * dt)
    bend = rng.normal(0, 0.5) * dt  # circles near a wall
    heading, speeds = np.empty(n), np.empty(n)
    angle, tumbling = rng.uniform(0, 2 * np.pi), 0.0
    for i in range(n):
        if tumbling > 0:
            tumbling -= dt
            angle += rng.normal(0, 3.0 * np.sqrt(dt / 0.1))
        else:
            angle += bend + rng.normal(0, wander)
            if rng.random() < rate * dt:
                tumbling = rng.exponential(0.12)
        heading[i] = angle
        speeds[i] = speed * (0.2 if tumbling > 0 else 1.0)
    speeds *= dt / world.pixel_size_um
    direction = np.stack([np.cos(heading), np.sin(heading)], axis=1)
    return speeds[:, None] * direction, heading


def _hops(world: World, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Rests, then steps of 0.5 to 1 px a frame at the paper's scale, as seen in collagen."""
    n, dt = world.frames, world.frame_interval_seconds
    steps, heading = np.zeros((n, 2)), np.empty(n)
    angle, i = rng.uniform(0, 2 * np.pi), 0
    rest = rng.choice([0.1, 0.5, 1.5])
    moving = rng.random() < 0.4
    while i < n:
        last = min(n, i + 1 + int(rng.exponential(rng.uniform(0.1, 0.8) if moving else rest) / dt))
        heading[i:last] = angle + np.cumsum(rng.normal(0, 0.3 * np.sqrt(dt), last - i))
        if moving:
            speed = world.speed_um_s * rng.uniform(0.5, 1.6) * dt / world.pixel_size_um
            steps[i:last, 0] = speed * np.cos(heading[i:last])
            steps[i:last, 1] = speed * np.sin(heading[i:last])
        angle = heading[last - 1] + rng.normal(0, 1.0) + (np.pi if rng.random() < 0.3 else 0.0)
        i, moving = last, not moving
    return steps, heading


def _around_its_tether(world: World, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Centre and heading of a body held at one point: most wiggle by tenths of a micrometre, some spin as their motor
    turns (Silverman & Simon 1974)."""
    n, dt = world.frames, world.frame_interval_seconds
    memory = float(np.exp(rng.uniform(np.log(0.02), np.log(0.5))))
    heading = np.full(n, rng.uniform(0, 2 * np.pi))
    if rng.random() < 0.2:
        heading += 2 * np.pi * rng.choice([-1, 1]) * rng.uniform(0.5, 8) * dt * np.arange(n)
    else:
        heading += _confined(n, dt, rng.uniform(0.02, 0.4), memory, rng)[:, 0]
    arm, reach = rng.uniform(0, 0.8), float(np.exp(rng.uniform(np.log(0.03), np.log(0.25))))
    centre = arm * np.stack([np.cos(heading), np.sin(heading)], axis=1) + _confined(n, dt, reach, memory, rng)
    return centre / world.pixel_size_um, heading


def _confined(n: int, dt: float, reach: float, memory: float, rng: np.random.Generator) -> Float64[np.ndarray, "n 2"]:
    """An Ornstein-Uhlenbeck walk of standard deviation `reach` and correlation time `memory` (seconds)."""
    keep = np.exp(-dt / memory)
    kicks = rng.normal(0, reach * np.sqrt(1 - keep**2), (n, 2))
    out = np.empty((n, 2))
    place = rng.normal(0, reach, 2)
    for i in range(n):
        place = keep * place + kicks[i]
        out[i] = place
    return out


def _depth(gait: Gait, world: World, rng: np.random.Generator) -> Float64[np.ndarray, " n"]:
    n, dt = world.frames, world.frame_interval_seconds
    if gait in (Gait.STUCK, Gait.TETHERED):
        return np.full(n, rng.normal(0, 0.6 * world.depth_spread))
    slow = {Gait.SWIMMING: 0.8, Gait.HOPPING: 1.5}.get(gait, 5.0)
    return _confined(n, dt, world.depth_spread, slow * rng.uniform(0.5, 2.0), rng)[:, 0]


def path_diffusivity(xy_um: Float64[np.ndarray, "n 2"], frame_interval_seconds: float) -> float:
    """The paper's motility measure of the path itself: the largest MSD(tau) / (4 tau) in um^2/s, over lags from one
    frame up to a quarter of the path.

    Not that of a track, `memtrack.motility.peak_diffusivity`, whose lags begin at 0.1 s and of which a floor is taken
    away: a path has no error of position. Another measure would give other labels to films that are made already.
    """
    lags = np.unique(np.geomspace(1, max(1, (len(xy_um) - 1) // 4), 12).astype(int))
    return max(
        (
            float(np.square(xy_um[k:] - xy_um[:-k]).sum(axis=1).mean() / (4 * k * frame_interval_seconds))
            for k in lags
            if k < len(xy_um)
        ),
        default=0.0,
    )
