# SPDX-License-Identifier: GPL-3.0-or-later
"""Films of single bright pixels to train on."""

import numpy as np

from memtrack.channels import NEUTRAL
from memtrack.training.samples import FilmSamples


def samples(rows: list[list[float]]) -> FilmSamples:
    features = np.full((1, 2, 64, 64), NEUTRAL, np.uint8)
    for x, y, *_ in rows:
        features[0, 0, int(y), int(x)] = 255
    return FilmSamples(features, (np.array(rows, np.float32).reshape(-1, 4),))
