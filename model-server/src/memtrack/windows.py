# SPDX-License-Identifier: GPL-3.0-or-later
"""The frames of a film that share a background.

A film has one background as long as it fits into one window. A longer one, whose fibres remodel and whose focus drifts,
has one for each of overlapping windows, and fades from one to the next. A bacterium that rests for more than half of a
window is part of its background and leaves a ghost when it goes, if it is not told (`memtrack.leavers`), so windows are
long and none is cut short at the film's ends. Where the scene is cut (`memtrack.cuts`), each shot has its own.
"""

from __future__ import annotations

import math
from bisect import bisect
from dataclasses import dataclass

from memtrack.film import Film

WINDOW_FRAMES = 900
WINDOW_SECONDS = 15.0
"""A window is no shorter than either, so that bacteria that rest for some seconds are not lost at any frame rate."""


@dataclass(frozen=True, slots=True)
class Windows:
    """`count` windows of `length` frames, spread evenly over the `frames` of a shot; each holds half of the next one or
    more."""

    frames: int
    length: int
    count: int

    @classmethod
    def of(cls, frames: int, interval_seconds: float | None) -> Windows:
        """As few as overlap by half."""
        length = max(WINDOW_FRAMES, round(WINDOW_SECONDS / interval_seconds) if interval_seconds else 0)
        if frames <= length:
            return cls(frames, frames, 1)
        return cls(frames, length, math.ceil(2 * frames / length) - 1)

    def window(self, number: int) -> range:
        """Its frames; among them are all that `near` gives it a share of."""
        first = round(number * self._step)
        return range(first, first + self.length)

    def near(self, frame: int) -> list[tuple[int, float]]:
        """The one or two windows whose middles are nearest to a frame, with the share of each; these add up to 1."""
        place = (frame - (self.length - 1) / 2) / self._step if self.count > 1 else 0.0
        place = min(max(place, 0.0), self.count - 1.0)
        first = math.floor(place)
        share = place - first
        return [(first, 1 - share), (first + 1, share)] if share else [(first, 1.0)]

    @property
    def _step(self) -> float:
        return (self.frames - self.length) / max(1, self.count - 1)


@dataclass(frozen=True, slots=True)
class Shots:
    """The windows of all shots of a film, numbered through; a shot begins at each of `starts`."""

    starts: tuple[int, ...]
    windows: tuple[Windows, ...]

    @classmethod
    def of(cls, film: Film, cuts: tuple[int, ...]) -> Shots:
        """Of a film whose scene is another one from each of `cuts` on."""
        starts, ends = (0, *cuts), (*cuts, film.frame_count)
        interval = film.calibration.frame_interval_seconds
        return cls(starts, tuple(Windows.of(end - start, interval) for start, end in zip(starts, ends, strict=True)))

    def window(self, number: int) -> range:
        """The film's frames in a window; among them are all that `near` gives it a share of."""
        shot = 0
        while number >= self.windows[shot].count:
            number -= self.windows[shot].count
            shot += 1
        window, start = self.windows[shot].window(number), self.starts[shot]
        return range(start + window.start, start + window.stop)

    def near(self, frame: int) -> list[tuple[int, float]]:
        """The windows that a frame of the film has a share in, see `Windows.near`."""
        shot = bisect(self.starts, frame) - 1
        before = sum(windows.count for windows in self.windows[:shot])
        return [(before + number, share) for number, share in self.windows[shot].near(frame - self.starts[shot])]
