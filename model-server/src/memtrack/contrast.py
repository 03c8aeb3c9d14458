# SPDX-License-Identifier: GPL-3.0-or-later
"""How much brighter or darker than the background a bacterium is, by which a tracker tells those that meet apart."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from memtrack.channels import NEUTRAL, Channel
from memtrack.detections import Detections

WINDOW_PX = 11
"""Edge of the square it is the mean of, at the model's scale: a bacterium with what surrounds it."""


def with_contrasts(found: Detections, deviation: Channel) -> Detections:
    """`found` with the contrast of each box, in [-1, 1]: the mean around its centre of v / (|v| + 10), where v is the
    deviation from the background in units of the noise.

    Args:
        found: boxes in pixels of the deviation, their centres inside it.
        deviation: v as `memtrack.channels.signed` squeezes it.
    """
    means = cv2.boxFilter(deviation, cv2.CV_32F, (WINDOW_PX, WINDOW_PX))
    columns, rows = np.rint(found.centres).astype(np.intp).T
    height, width = means.shape
    at_centres = means[rows.clip(0, height - 1), columns.clip(0, width - 1)]
    return replace(found, contrasts=(at_centres - NEUTRAL) / np.float32(127))
