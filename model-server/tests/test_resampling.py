# SPDX-License-Identifier: GPL-3.0-or-later
from dataclasses import replace

import numpy as np
import pytest

from memtrack.boxes import square_boxes
from memtrack.detections import Detections
from memtrack.film import ArrayFilm
from memtrack.pipeline import to_film
from memtrack.resampling import ScaledFilm, factors_of


@pytest.mark.parametrize("factor", [0.31, 0.7, 2.3])
def test_what_is_found_at_the_lower_right_of_a_scaled_film_lies_there_in_the_film(factor: float) -> None:
    y, x = np.mgrid[:63, :101]
    spot = np.exp(-((x - 89.3) ** 2 + (y - 52.6) ** 2) / (2 * 3**2)).astype(np.float32)
    film = ArrayFilm(spot[None])
    scaled = ScaledFilm(film, factor)
    image = scaled.frame(0).astype(np.float64)
    rows, columns = np.mgrid[: scaled.height, : scaled.width]
    centre = np.array([[(image * places).sum() / image.sum() for places in (columns, rows)]])
    boxes = square_boxes(centre, 30 * factor).astype(np.float32)
    found = Detections(boxes, np.ones(1, np.float32), np.zeros(1, np.int8))
    found = replace(found, errors=np.full(1, 0.5, np.float32))
    there = to_film(found, (0.0, 0.0), factors_of(film, scaled))
    box = there.boxes[0]
    assert there.errors is not None
    np.testing.assert_allclose(there.errors, 0.5 / factor, rtol=0.05)
    np.testing.assert_allclose([(box[0] + box[2]) / 2, (box[1] + box[3]) / 2], [89.3, 52.6], atol=0.15)
