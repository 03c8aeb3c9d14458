# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the work on one film stands: its stages, how much of the whole is done and how long the rest may take."""

from __future__ import annotations

import enum
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass


class Stage(enum.IntEnum):
    """Step of the work, in order; the numbers are those of the contract."""

    RECEIVING = 1
    STABILISING = 2
    BACKGROUND = 3
    DETECTING = 4


Report = Callable[[Stage, int, int], None]
"""`report(stage, done, total)`, called at least once a frame; raises CancelledError when nobody wants the result."""


@dataclass(frozen=True, slots=True)
class Standing:
    """Where the work stands: frames of the stage, share of the whole in [0, 1], seconds left where they can be told."""

    stage: Stage
    frames_done: int
    frames_total: int
    fraction: float
    seconds_left: float | None


class StageCosts:
    """What each stage costs in nanoseconds per pixel, learned from the films a process has worked on.

    The first film runs on values measured on two cores; each later one moves them half-way to its own.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._costs = {Stage.RECEIVING: 4.0, Stage.STABILISING: 22.0, Stage.BACKGROUND: 1.0, Stage.DETECTING: 50.0}

    def current(self) -> dict[Stage, float]:
        """A copy of the costs as they are now."""
        with self._lock:
            return dict(self._costs)

    def learn(self, seconds: dict[Stage, float], pixels: int) -> None:
        """Takes in what a finished film of `pixels` (all frames together) took in each stage."""
        with self._lock:
            for stage, spent in seconds.items():
                self._costs[stage] = (self._costs[stage] + spent * 1e9 / pixels) / 2


class ProgressClock:
    """Turns reports of single stages into the standing of the whole work; its fraction never goes back.

    Time passed between two reports is put down to the stage of the later one; call `restart` after a wait that is no
    work, such as for another film. Not safe for threads: one stage works at a time.
    """

    def __init__(
        self, frame_count: int, costs: dict[Stage, float], *, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._frame_count = frame_count
        self._costs = costs
        self._clock = clock
        self._last = clock()
        self.standing = Standing(Stage.RECEIVING, 0, frame_count, 0.0, None)
        self.seconds: dict[Stage, float] = {}

    def restart(self) -> None:
        """Forgets the time since the last report."""
        self._last = self._clock()

    def advance(self, stage: Stage, done: int, total: int) -> Standing:
        """Takes in that `stage` has finished `done` of `total` steps."""
        now = self._clock()
        self.seconds[stage] = self.seconds.get(stage, 0.0) + now - self._last
        self._last = now
        share = min(1.0, done / total)
        before = sum(cost for other, cost in self._costs.items() if other < stage)
        fraction = (before + share * self._costs[stage]) / sum(self._costs.values())
        self.standing = Standing(
            stage,
            int(share * self._frame_count),
            self._frame_count,
            max(self.standing.fraction, fraction),
            self._seconds_left(stage, share),
        )
        return self.standing

    def _seconds_left(self, stage: Stage, share: float) -> float | None:
        """What is left of this stage at its own pace, and of later ones at the pace this one has against its cost."""
        spent = self.seconds[stage]
        if spent < 0.5 or share < 0.02:
            return None
        whole = spent / share
        pace = whole / self._costs[stage]
        return whole - spent + pace * sum(cost for other, cost in self._costs.items() if other > stage)
