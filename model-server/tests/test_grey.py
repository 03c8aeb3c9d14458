# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np
import pytest

from memtrack.errors import FilmError
from memtrack.video.source import grey


def test_colours_of_floating_point_are_not_rounded() -> None:
    colour = np.array([[[0.2, 0.4, 0.1]]], np.float32)
    np.testing.assert_allclose(grey(colour), [[0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.1]], rtol=1e-6)


def test_a_black_and_white_image_is_grey() -> None:
    np.testing.assert_array_equal(grey(np.array([[True, False]])), np.array([[255, 0]], np.uint8))
    with pytest.raises(FilmError, match="are not grey levels"):
        grey(np.zeros((2, 2), np.complex64))
