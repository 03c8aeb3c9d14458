# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds: what changes in a film on a larger scale than bacteria, as in mucus.

Where clouds are most of what changes, bacteria would pass for noise, since a deviation is counted in units of all that
changes. So the deviations of such a film are freed of clouds, and counted in units of what changes besides. Not a part
of the paper.
"""

from __future__ import annotations

import numpy as np

from memtrack.background import Background, aligned_frame, split_drift
from memtrack.channels import Image, coarse
from memtrack.film import Film
from memtrack.stabilisation import FilmMotion

REACH_PX = 8.0
"""Width (sigma) of the Gaussian windows that clouds fill and a bacterium does not."""
WIDE_PX, MOST_BESIDES = 24.0, 0.8
"""A film is clouded where less than this share of all that changes is left without what fills windows of this width.
Where only smaller bodies move it is not: without their surroundings these look like bacteria."""
SHRINK = 4
"""Windows are averaged at this fraction of the size."""
SIGHTS = 5
"""Frames in which it is measured."""
CLIPPED = 3.0
"""Deviations count up to this, in units of the noise, when clouds are told a second time, without bacteria."""


def change_besides_clouds(background: Background, film: Film, motion: FilmMotion, frames: range) -> float:
    """Typical size, in grey levels, of what changes besides clouds; of all that changes where the film has none.

    The numbers were chosen on simulated films (docs/experiments.md, "Clouds").

    Args:
        film, motion: frames as the camera took them, and how the scene stands in them.
        frames: consecutive ones of the film, those the background is made of.
    """
    besides = []
    for i in motion.sampled(frames, SIGHTS):
        seen = background.window(split_drift(motion.drift[i])[0], film.height, film.width)
        change = aligned_frame(film, motion, i) - background.median[seen]
        besides.append([_typical(change - coarse(change, reach, SHRINK)) for reach in (WIDE_PX, REACH_PX)])
    wide, close = np.median(besides, axis=0)
    return float(close if wide < MOST_BESIDES * background.noise else background.noise)


def take_out_clouds(deviation: Image) -> None:
    """Takes clouds out of `deviation`, in units of the noise, in place; a second time without what stands out of them,
    so that a bacterium leaves no cloud of the other sign around it."""
    deviation -= coarse(deviation, REACH_PX, SHRINK)
    deviation -= coarse(np.clip(deviation, -CLIPPED, CLIPPED), REACH_PX, SHRINK)


def _typical(change: Image) -> float:
    """Size that 68 % do not exceed: the standard deviation, where change is distributed normally. Every ninth pixel
    is enough to tell."""
    return float(np.quantile(np.abs(change[::3, ::3]), 0.6827))
