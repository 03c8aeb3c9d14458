# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the scene of a film becomes another at once, as when the focus jumps: one median of both would fit neither."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Float64, Int

from memtrack.film import Film
from memtrack.resampling import HALF_WIDTH, read_shifted

EDGE_PX, LEAST_EDGE_PX = 160, 48
"""Edge of the part of the field that is looked at, at most and at least; every other pixel along it is enough."""
SIDE = 4
"""Frames before and after whose means are compared."""
FAR = 10
"""Frames from a cut within which no other is looked for; the outer half of them tell how much usually changes there."""
CUT, CUT_OF_ALL, TEXTURE = 1.6, 1.5, 0.12
"""The scene is cut where so many times as much changes as some frames before and after, and as is usual in the film,
and what is more is this share of the texture; where a packed film begins anew it is less."""
LEAST_FRAMES = 20
"""Of a shot: fewer tell no background."""

Part = Float32[np.ndarray, "part_h part_w"]


@dataclass(frozen=True, slots=True)
class ScenePart:
    """A part of the scene that all frames show: its upper left corner where the scene has not drifted, and its size,
    both (x, y)."""

    corner: Int[np.ndarray, " 2"]
    size: Int[np.ndarray, " 2"]

    @classmethod
    def of(cls, film: Film, drift: Float64[np.ndarray, "n 2"]) -> ScenePart:
        """In the middle of what frames show whose scenes stand `drift` (x, y) from its place."""
        low = HALF_WIDTH + 1 - np.floor(drift.min(axis=0)).astype(int)
        high = np.array([film.width, film.height]) - HALF_WIDTH - 1 - np.ceil(drift.max(axis=0)).astype(int)
        size = np.clip(high - low, 0, EDGE_PX)
        return cls((low + high - size) // 2, size)

    def seen_in(self, frame: Float32[np.ndarray, "h w"], drift: Float64[np.ndarray, " 2"]) -> Part:
        """The part in a frame whose scene stands `drift` from its place; smaller where it is not all in the frame."""
        whole = np.rint(drift).astype(int)
        x, y = np.clip(self.corner + whole - HALF_WIDTH, 0, None)
        across, down = self.size + 2 * HALF_WIDTH
        around = frame[y : y + down, x : x + across]
        if around.size:
            around = read_shifted(around, *(drift - whole))
        inner = slice(HALF_WIDTH, -HALF_WIDTH)
        return around[inner, inner]


class SceneChanges:
    """How much the scene changes from some frames to the next ones, told by a part of the field."""

    def __init__(self) -> None:
        self._parts: deque[tuple[int, Part]] = deque(maxlen=2 * SIDE)
        self._shape: tuple[int, ...] = ()
        self._frames: list[int] = []
        self._changes: list[float] = []
        self._textures: list[float] = []

    def add(self, index: int, part: Part) -> None:
        """Frames in their order; of each the same part of the scene, aligned and in the same light. One that does not
        show all of the part is passed over."""
        self._shape = self._shape or part.shape
        if min(part.shape) < LEAST_EDGE_PX or part.shape != self._shape:
            return
        self._parts.append((index, part[::2, ::2].copy()))
        if len(self._parts) == 2 * SIDE:
            images = [image for _, image in self._parts]
            before, after = (sum(side[1:], side[0]) / np.float32(SIDE) for side in (images[:SIDE], images[SIDE:]))
            self._frames.append(self._parts[SIDE][0])
            change = after - before
            self._changes.append(float(np.median(np.abs(change - change.mean()))))
            self._textures.append(float(np.abs(before - before.mean()).mean()))

    def cuts(self, frame_count: int) -> tuple[int, ...]:
        """First frames of the shots after the first one."""
        changes, cuts = np.array(self._changes), [0]
        for k, frame in enumerate(self._frames):
            near = changes[max(0, k - FAR) : k + FAR + 1]
            if changes[k] < near.max() or frame - cuts[-1] < LEAST_FRAMES or frame_count - frame < LEAST_FRAMES:
                continue
            beside = [*changes[max(0, k - FAR) : max(0, k - FAR // 2)], *changes[k + FAR // 2 + 1 : k + FAR + 1]]
            there = float(np.median(beside)) if beside else math.inf
            # Strictly more: where nothing at all changes, as in front of pure black, nothing is cut.
            jumps = changes[k] > CUT * there and changes[k] > CUT_OF_ALL * np.median(changes)
            if jumps and changes[k] ** 2 - there**2 >= (TEXTURE * self._textures[k]) ** 2:
                cuts.append(frame)
        return tuple(cuts[1:])
