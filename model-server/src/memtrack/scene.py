# SPDX-License-Identifier: GPL-3.0-or-later
"""The still scene a frame is compared with, which may change in a long film, or where it is cut."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np

from memtrack.background import Background, Progress, split_drift, temporal_background
from memtrack.channels import Channel, Image, shading_of, signed
from memtrack.clouds import change_besides_clouds
from memtrack.film import Film
from memtrack.fixed_pattern import fixed_pattern
from memtrack.leavers import without_leavers
from memtrack.resting import Looks, without_resting
from memtrack.spots import Spots
from memtrack.stabilisation import FilmMotion
from memtrack.tethered import without_tethered
from memtrack.windows import Shots
from memtrack.wobble import Slopes


@dataclass(frozen=True, slots=True)
class Still:
    """A background with what the features need of it: its shading, mean grey `level` and `texture`, its spread as a
    channel, its slopes, the `noise` a deviation is counted in, in grey levels, and whether it is `clouded`."""

    background: Background
    shading: Image
    spread: Channel
    slopes: Slopes
    level: float
    noise: float
    texture: float
    clouded: bool

    @classmethod
    def of(cls, background: Background, besides_clouds: float, *, whole_numbers: bool) -> Still:
        """Measures `background`.

        Args:
            besides_clouds: see `change_besides_clouds`.
            whole_numbers: whether the film holds only such.
        """
        median = background.median
        shading = shading_of(median)
        texture = float(np.std(median - shading))
        # Without noise (simulated or compressed films) residues of the scene are what a deviation must exceed.
        rounding = 0.29 if whole_numbers else 1e-4 * float(np.abs(median).mean()) + 1e-9
        least = (0.03 * texture, rounding)
        noise = float(np.linalg.norm([background.noise, *least]))
        spread = signed(background.spread / np.float32(noise) - 1)
        # Where less than rounding is left, packing has taken the noise out, and what flickers is no clouds.
        clouded = rounding < besides_clouds < background.noise
        if clouded:
            noise = float(np.linalg.norm([besides_clouds, *least]))
        slopes = Slopes.of(median, noise)
        level, texture = float(median.mean()), float(np.hypot(texture, noise))
        return cls(background, shading, spread, slopes, level, noise, texture, clouded)

    def with_median_of(self, background: Background) -> Still:
        """Of the same scene, whose noise and texture it keeps, but with another median to compare frames with."""
        median = background.median
        return replace(self, background=background, shading=shading_of(median), slopes=Slopes.of(median, self.noise))


class Scene:
    """The still scene at any frame of a film, on the grid of its aligned frame.

    Makes the first background at once, with `report(done, total)` for each frame it reads, and later ones when they are
    first asked for, with `alive()` for each frame. Of a film that is gone through forwards each is made once, and only
    those nearby are kept.
    """

    def __init__(
        self,
        film: Film,
        motion: FilmMotion,
        *,
        report: Progress,
        alive: Callable[[], None] = lambda: None,
        threads: int = 1,
    ) -> None:
        self.film, self.motion, self._threads = film, motion, threads
        self._shots = Shots.of(film, motion.cuts)
        self._whole_numbers = film.frame(0).dtype.kind == "u"
        self._looks: Looks | None = None
        self._stills = {0: self._made(0, report)}
        self._slopes: tuple[tuple[int, tuple[int, int]], Slopes] | None = None
        self._alive = alive

    def free_resting(self, looks: Looks) -> int:
        """Takes bacteria that rest out of all backgrounds, and says how many the first one has; for a scene of which no
        other is made yet. looks: of the film's bacteria that move."""
        self._looks, self._slopes = looks, None
        still = self._stills[0]
        background, count = without_resting(still.background, still.noise, looks)
        self._stills[0] = still.with_median_of(background)
        return count

    @property
    def middle(self) -> int:
        """The frame in the middle of the first background's."""
        return len(self._shots.window(0)) // 2

    def place(self, index: int) -> tuple[int, int]:
        """Whole pixels (x, y) the scene stands from its place in frame 0."""
        return split_drift(self.motion.drift[index])[0]

    def median(self, index: int) -> Image:
        """Temporal median, in grey levels."""
        return self._faded(index, lambda still: still.background.median)

    def shading(self, index: int) -> Image:
        """The median without the scene's texture."""
        return self._faded(index, lambda still: still.shading)

    def spread(self, index: int) -> Channel:
        """Temporal spread less the noise, in units of it, as a signed channel."""
        return self._faded(index, lambda still: still.spread)

    def slopes(self, index: int) -> Slopes:
        """Slopes of the median; between two windows' backgrounds, of the nearer one."""
        number, place = self._nearest(index), self.place(index)
        if self._slopes is None or self._slopes[0] != (number, place):  # the same for many frames of a slow drift
            still = self._still(number)
            window = still.background.window(place, self.film.height, self.film.width)
            self._slopes = (number, place), still.slopes.seen(*window)
        return self._slopes[1]

    def clouded(self, index: int) -> bool:
        """Whether clouds are to be taken out of the frame's deviation (`memtrack.clouds`)."""
        return self._still(self._nearest(index)).clouded

    def noise(self, index: int) -> float:
        """What a deviation must exceed, in grey levels."""
        return self._value(index, lambda still: still.noise)

    def texture(self, index: int) -> float:
        """Standard deviation of the scene with its noise, in grey levels."""
        return self._value(index, lambda still: still.texture)

    def level(self, index: int) -> float:
        """Mean of the median."""
        return self._value(index, lambda still: still.level)

    def _nearest(self, index: int) -> int:
        return max(self._shots.near(index), key=lambda near: near[1])[0]

    def _value(self, index: int, of: Callable[[Still], float]) -> float:
        return sum(share * of(self._still(number)) for number, share in self._shots.near(index))

    def _faded(self, index: int, of: Callable[[Still], np.ndarray]) -> np.ndarray:
        place, h, w = self.place(index), self.film.height, self.film.width
        near = [(self._still(number), share) for number, share in self._shots.near(index)]
        images = [of(still)[still.background.window(place, h, w)] for still, _ in near]
        if len(near) == 1:
            return images[0]
        return np.asarray(cv2.addWeighted(images[0], near[0][1], images[1], near[1][1], 0))

    def _still(self, number: int) -> Still:
        if number not in self._stills:
            # Three: while a coming frame needs the third, the current one may still need the first.
            for old in [k for k in self._stills if abs(k - number) > 2]:
                del self._stills[old]
            self._stills[number] = self._made(number, lambda done, total: self._alive())
        return self._stills[number]

    def _made(self, number: int, report: Progress) -> Still:
        window, reached = self._shots.window(number), (1, 1)

        def read(done: int, total: int) -> None:
            nonlocal reached
            reached = done, total
            report(done, total)

        background = self._background(window, read)
        if number == 0:  # told once, so that all backgrounds are of the same frames
            pattern = fixed_pattern(self.film, self.motion, background, window)
            if pattern is not None:
                self.motion = replace(self.motion, pattern=pattern)
                background = self._background(window, read)
        besides_clouds = change_besides_clouds(background, self.film, self.motion, window)
        still = Still.of(background, besides_clouds, whole_numbers=self._whole_numbers)
        spots = Spots.of(background, still.noise)
        samples = spots.samples(background, self.film, self.motion, window, lambda: report(*reached))
        freed, spots = without_leavers(background, spots, samples)
        freed = without_tethered(freed, spots, samples, still.noise)
        if self._looks is not None:
            freed, _ = without_resting(freed, still.noise, self._looks)
        return still if freed is background else still.with_median_of(freed)

    def _background(self, window: range, report: Progress) -> Background:
        return temporal_background(self.film, self.motion, report=report, frames=window, threads=self._threads)
