# SPDX-License-Identifier: GPL-3.0-or-later
"""What a few frames tell before all are worked on: how bacteria that rest would look, and whether there is a crowd."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from memtrack.detections import FrameDetections
from memtrack.motion import FilmFeatures
from memtrack.nets import Nets
from memtrack.pruning import PrunerSettings, prune
from memtrack.resting import Looks
from memtrack.scene import Scene

SIGHTS = 5
"""Frames in which bacteria that move are measured."""
SUSPECTED_ROOM_PX2, CROWDED_ROOM_PX2, CROWD = 8000.0, 3500.0, 20
"""A film is a crowd, and the model's model for crowds takes over, where that one finds `CROWD` bacteria in a frame or
more, with less than `CROWDED_ROOM_PX2` square pixels for each, at the model's scale. It is asked only where the model
itself has less than `SUSPECTED_ROOM_PX2` for each box, faint ones among them: of some crowds it finds hardly more."""


def free_resting(
    scene: Scene, features: FilmFeatures, nets: Nets, pruner: PrunerSettings, alive: Callable[[], None]
) -> str:
    """Takes bacteria that rest out of the scene, by the looks of those that move; what the user should know.

    Args:
        scene, features: of one film; the features of the scene as it was are of no more use.
        pruner: what is dropped of candidates, at the model's scale.
        alive: called for each frame that is looked at.
    """
    moving = []
    for i in np.unique(np.linspace(0, 2 * scene.middle, SIGHTS + 2)[1:-1].astype(int)).tolist():
        alive()
        moving.append((features.deviation(i), prune(nets.candidates(features.channels(i)), pruner)[0]))
    looks = Looks.of(moving)
    if looks is None:
        return "No resting bacteria were looked for: too few move that could tell how a bacterium of this film looks."
    count = scene.free_resting(looks)
    if not count:
        return "No resting bacteria were found: nothing that never moves is as dark or as bright as those that move."
    return f"{count} spot(s) that never move are as dark or as bright as the bacteria that move, and may be found, too."


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
