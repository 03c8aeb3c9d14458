# SPDX-License-Identifier: GPL-3.0-or-later
"""The scale at which a model sees a film: its cells as long as those the model was trained on."""

from __future__ import annotations

import numpy as np

from memtrack.errors import SettingsError
from memtrack.film import Calibration, Film
from memtrack.models import Model
from memtrack.settings import DetectionSettings

CELL_LENGTH_UM = 2.0
"""Length of the bacteria the models are trained on (paper: rods of about 2 x 0.8 um)."""
SCALES = (0.05, 8.0)
"""Least and greatest factor frames are scaled by: what is more is a mistake, and would not fit into memory."""
MOST_BY_PIXEL_SIZE = 3.0
"""A pixel size alone enlarges frames no further: cells of 2 um would be little more than a pixel long, and hardly seen;
such a film shows something larger, microrobots most likely."""


def model_scale(film: Film, model: Model, settings: DetectionSettings) -> float:
    """Factor that brings the film's cells to a length the model knows; 1 where they have one already.

    Raises:
        SettingsError: it is outside `SCALES`.
    """
    known = model.card.cell_length_px
    stated = settings.cell_length_px
    if stated is None:
        return scale_to(known, film.calibration)
    return _factor(known, stated, f"a cell length of {stated:g} pixels", "the length of a cell in this film")


def scale_to(cell_length_px: tuple[float, float], calibration: Calibration) -> float:
    """Factor that brings a film of this pixel size to cells of a length in `cell_length_px`; 1 without a pixel size, or
    where it tells that the film `shows_larger` things.

    Raises:
        SettingsError: it is outside `SCALES`.
    """
    size = calibration.pixel_size_um
    if size is None:
        return 1.0
    given = f"a pixel size of {size:g} um"
    factor = _factor(cell_length_px, CELL_LENGTH_UM / size, given, "the true pixel size, or the length of a cell")
    return 1.0 if shows_larger(cell_length_px, calibration) else factor


def shows_larger(cell_length_px: tuple[float, float], calibration: Calibration) -> bool:
    """Whether the pixel size is so great that the film must show something larger than cells, see
    `MOST_BY_PIXEL_SIZE`."""
    size = calibration.pixel_size_um
    return size is not None and cell_length_px[0] * size > MOST_BY_PIXEL_SIZE * CELL_LENGTH_UM


def _factor(known: tuple[float, float], length: float, given: str, wanted: str) -> float:
    factor = float(np.clip(length, *known)) / length
    if not SCALES[0] <= factor <= SCALES[1]:
        raise SettingsError(
            f"{given} means scaling the frames by {factor:.3g}, but {SCALES[0]:g} to {SCALES[1]:g} is possible; "
            f"give {wanted}"
        )
    return factor
