# SPDX-License-Identifier: GPL-3.0-or-later
"""What a few frames tell before all are worked on: whether the film's cells are longer than expected, how
bacteria that rest would look, and whether there is a crowd."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import cv2
import numpy as np

from memtrack.detections import Detections, FrameDetections
from memtrack.nets import Nets
from memtrack.pruning import PrunerSettings, prune
from memtrack.resting import Looks
from memtrack.view import View

SIGHTS, CLOSE_SIGHTS = 5, 3
"""Frames that are looked at for the bacteria that move: spread over the film, or, where it must not take long, those in
its middle, which share most of what their features need."""
SMALLER, LEAST_EDGE_PX = (0.35, 0.5, 0.25), 64
"""Scales that are tried against the usual one, and the edge of a frame at the least of them."""
PROMISING, SURER, MORE, AS_SURE = 0.75, 1.25, 1.0, 0.95
"""A smaller scale is taken where the sum of the scores in a frame is `SURER` times that at the usual scale, and `MORE`
more; and of several scales the largest that has `AS_SURE` of the greatest sum. After the first one the others are only
tried where it has `PROMISING` of the usual sum: in a third of the films whose cells are as long as expected."""
BROAD = 0.35
"""What is found at the smaller scale must be broad: its deviation 6 to 8 px from the centre, squared and at the usual
scale, is this share of that within 3 px, or more. Of faint bacteria, too, more is found at a smaller scale, where there
is less noise: there it is 0.1 at most, and 0.6 or more of bacteria twice to four times as long as expected."""
SUSPECTED_ROOM_PX2, CROWDED_ROOM_PX2, CROWD = 8000.0, 3500.0, 20
"""A film is a crowd, and the model's model for crowds takes over, where that one finds `CROWD` bacteria in a frame or
more, with less than `CROWDED_ROOM_PX2` square pixels for each, at the model's scale. It is asked only where the model
itself has less than `SUSPECTED_ROOM_PX2` for each box, faint ones among them: of some crowds it finds hardly more."""

Sight = tuple[int, Detections]
"""A frame, and what is found in it."""


def fitting(view: View, nets: Nets, pruner: PrunerSettings, alive: Callable[[], None], threads: int) -> View:
    """`view`, or a smaller one of the same film in which the nets find more bacteria or are surer of them: where these
    are much longer than those the model knows, it sees parts of them at best.

    Args:
        view: of a film whose bacteria may be longer than expected.
        pruner: what is dropped of candidates, at the model's scale.
        alive: called for each frame that is looked at.
        threads: at work on backgrounds.
    """
    edge = min(view.scene.film.height, view.scene.film.width)
    if edge * max(SMALLER) < LEAST_EDGE_PX:
        return view
    first = max(0, view.scene.middle - CLOSE_SIGHTS // 2)
    middle = range(first, min(first + CLOSE_SIGHTS, view.film.frame_count))
    usual = _sureness(_found(middle, view, nets, pruner, alive))
    tried: dict[float, tuple[float, View, list[Sight]]] = {}
    for factor in SMALLER:
        if factor * edge >= LEAST_EDGE_PX:
            smaller = view.shrunk(factor, alive=alive, threads=threads)
            sights = list(_found(middle, smaller, nets, pruner, alive))
            tried[factor] = _sureness(sights), smaller, sights
            if len(tried) == 1 and tried[factor][0] < PROMISING * usual:
                return view
    best = max(sure for sure, _, _ in tried.values())
    if best <= SURER * usual + MORE:
        return view
    factor = max(factor for factor, (sure, _, _) in tried.items() if sure >= AS_SURE * best)
    _, smaller, sights = tried[factor]
    return smaller if _are_broad(sights, factor, view) else view


def _sureness(sights: Iterable[Sight]) -> float:
    return float(np.mean([found.scores.sum() for _, found in sights]))


def _are_broad(sights: Iterable[Sight], factor: float, usual: View) -> bool:
    """Whether what was found at `factor` of the usual scale is broad there, see `BROAD`."""
    y, x = np.mgrid[-8:9, -8:9]
    radius = np.hypot(x, y)
    within = []
    for i, found in sights:
        power = np.square(np.clip(usual.features.deviation(i), -10, 10))
        power -= float(np.median(power)) / 0.455  # the median of squares of normally distributed noise
        height, width = power.shape
        across, down = np.rint((found.centres + 0.5) / factor - 0.5).astype(int).T
        at = np.clip(down, 0, height - 1), np.clip(across, 0, width - 1)
        for ring in (radius < 3, (radius >= 6) & (radius < 8)):
            within.append(cv2.filter2D(power, cv2.CV_32F, ring / ring.sum())[at].sum())
    return float(np.sum(within[1::2])) >= BROAD * float(np.sum(within[::2]))


def free_resting(view: View, nets: Nets, pruner: PrunerSettings, alive: Callable[[], None]) -> str:
    """Takes bacteria that rest out of the scene, by the looks of those that move; what the user should know.

    Args:
        view: whose scene is changed, so that its features are of no more use.
        pruner: what is dropped of candidates, at the model's scale.
        alive: called for each frame that is looked at.
    """
    spread = np.unique(np.linspace(0, 2 * view.scene.middle, SIGHTS + 2)[1:-1].astype(int)).tolist()
    looks = Looks.of((view.features.deviation(i), found) for i, found in _found(spread, view, nets, pruner, alive))
    if looks is None:
        return "No resting bacteria were looked for: too few move that could tell how a bacterium of this film looks."
    count = view.scene.free_resting(looks)
    if not count:
        return "No resting bacteria were found: nothing that never moves is as dark or as bright as those that move."
    return f"{count} spot(s) that never move are as dark or as bright as the bacteria that move, and may be found, too."


def _found(
    frames: Iterable[int], view: View, nets: Nets, pruner: PrunerSettings, alive: Callable[[], None]
) -> Iterator[Sight]:
    """What is found in each of some frames, at the model's scale."""
    for i in frames:
        alive()
        yield i, prune(nets.candidates(view.features.channels(i)), pruner)[0]


def crowd_in(usual: FrameDetections, for_crowds: Callable[[], FrameDetections], area: float) -> int:
    """How many bacteria the model for crowds finds in a frame that is a crowd; 0 where it is none.

    Args:
        usual: what the model itself finds there.
        for_crowds: asks the model for crowds.
        area: of the frame, or of its part that counts, in square pixels at the model's scale.
    """
    if area >= SUSPECTED_ROOM_PX2 * (len(usual.detections) + len(usual.faint)):
        return 0
    count = len(for_crowds().detections)
    return count if count >= CROWD and area < CROWDED_ROOM_PX2 * count else 0
