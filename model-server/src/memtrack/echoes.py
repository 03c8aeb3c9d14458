# SPDX-License-Identifier: GPL-3.0-or-later
"""Echoes: what the net finds in a frame where a fast bacterium was two frames before, or will be two frames later.

The features show the net the neighbouring frames, too, and where a bacterium moves by more than its length from one to
the next, as in films of few frames a second, it stands there beside itself.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float64

from memtrack.channels import KNEE, NEUTRAL, Channel
from memtrack.detections import Detections

NEIGHBOURS = ("deviation-2", "deviation+2")
"""Channels of the features that show them."""
NOTHING, ECHO = 1.5, 0.15
"""An echo is where there is less than `NOTHING`, noise alone being 1, and less than this share of what is there in a
neighbouring frame: that is 3.4 or more on 19 of 20 boxes on bacteria that move by 8 px a frame, and 0.04 or less on
19 of 20 of their echoes."""
REACH_PX = 4
"""What is there is told within a square that reaches so far from the centre."""
MOST = 20.0
"""Deviations beyond so many units of the noise count as these."""

_VALUES = np.arange(256) - float(NEUTRAL)
_POWER = np.minimum(np.square(KNEE * _VALUES / np.maximum(127 - np.abs(_VALUES), 0.5)), MOST**2)
"""The square of the deviation that each grey level of a channel stands for (`memtrack.channels.signed`)."""


def without_echoes(found: Detections, deviation: Channel, neighbours: list[Channel]) -> Detections:
    """`found` without echoes.

    Args:
        found: boxes in pixels of the channels.
        deviation: from the background in this frame.
        neighbours: likewise in neighbouring frames, at least one.
    """
    now = _power(deviation, found)
    beside = np.max([_power(channel, found) for channel in neighbours], axis=0)
    return found.select(now >= np.minimum(NOTHING, ECHO * beside))


def _power(channel: Channel, found: Detections) -> Float64[np.ndarray, " n"]:
    """Mean square of the deviation around the centre of each box, in units of the noise's."""
    height, width = channel.shape
    x, y = np.rint(found.centres).astype(np.intp).T
    around = np.arange(-REACH_PX, REACH_PX + 1)
    rows = (y[:, None, None] + around[:, None]).clip(0, height - 1)
    columns = (x[:, None, None] + around).clip(0, width - 1)
    power: np.ndarray = _POWER[channel[rows, columns]].mean(axis=(1, 2))
    return power
