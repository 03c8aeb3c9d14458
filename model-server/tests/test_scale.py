# SPDX-License-Identifier: GPL-3.0-or-later
"""By what factor a film is brought to the cells that a model knows."""

import re
from dataclasses import replace

import numpy as np
import pytest

from memtrack.errors import SettingsError
from memtrack.film import ArrayFilm, Calibration
from memtrack.models import Model, load_model
from memtrack.pipeline import caveats
from memtrack.scale import model_scale
from memtrack.settings import DetectionSettings


@pytest.fixture(scope="module")
def model() -> Model:
    return load_model()


def test_a_stated_cell_length_takes_the_place_of_a_calibration(model: Model) -> None:
    film = ArrayFilm(np.zeros((1, 8, 8), np.uint8), Calibration(0.01, None))
    low, high = model.card.cell_length_px
    assert model_scale(film, model, DetectionSettings(cell_length_px=(low + high) / 2)) == 1
    assert model_scale(film, model, DetectionSettings(cell_length_px=2 * high)) == pytest.approx(0.5)
    assert model_scale(film, model, DetectionSettings()) == pytest.approx(high / 200)
    assert model_scale(replace(film, calibration=Calibration()), model, DetectionSettings()) == 1


def test_where_cells_would_be_a_pixel_long_the_film_shows_something_larger_and_is_not_enlarged(model: Model) -> None:
    small, large = (ArrayFilm(np.zeros((20, 8, 8), np.uint8), Calibration(size)) for size in (1.3, 2.2))
    assert model_scale(small, model, DetectionSettings()) == pytest.approx(model.card.cell_length_px[0] * 1.3 / 2)
    assert caveats(small, model, DetectionSettings()) == []
    assert model_scale(large, model, DetectionSettings()) == 1
    (said,) = caveats(large, model, DetectionSettings())
    assert re.match(r"With pixels of 2\.2 um, cells of 2 um could hardly be seen, .* give the length", said)
    stated = DetectionSettings(cell_length_px=36.0)
    assert model_scale(large, model, stated) == pytest.approx(model.card.cell_length_px[1] / 36)
    assert caveats(large, model, stated) == []
    tiny = replace(small, calibration=Calibration(0.02))
    assert caveats(tiny, model, DetectionSettings()) == [
        "Frames are scaled by 0.12 to reach the model's scale; check the pixel size."
    ]
    assert caveats(tiny, model, DetectionSettings(cell_length_px=100)) == []


@pytest.mark.parametrize(
    ("pixel_size_um", "sentence"),
    [
        (25400.0, r"a pixel size of 25400 um means scaling the frames by 4\.83e\+04, but 0\.05 to 8 is possible"),
        (10.0, "a pixel size of 10 um means scaling the frames by 19, .*; give the true pixel size, or the length"),
        (0.001, r"a pixel size of 0\.001 um means scaling the frames by 0\.006"),
        (1e-320, "means scaling the frames by 0,"),
    ],
)
def test_a_scale_that_makes_no_sense_is_refused_with_what_led_to_it(
    pixel_size_um: float, sentence: str, model: Model
) -> None:
    film = ArrayFilm(np.zeros((1, 8, 8), np.uint8), Calibration(pixel_size_um))
    with pytest.raises(SettingsError, match=sentence):
        model_scale(film, model, DetectionSettings())


def test_every_cell_length_that_can_be_stated_has_a_scale(model: Model) -> None:
    film = ArrayFilm(np.zeros((1, 8, 8), np.uint8), Calibration(25400))
    for length in (1.0, 200.0):
        assert 0.05 < model_scale(film, model, DetectionSettings(cell_length_px=length)) < 8
    large = replace(model, card=replace(model.card, cell_length_px=(30.0, 60.0)))
    with pytest.raises(SettingsError, match="a cell length of 1 pixels means scaling the frames by 30"):
        model_scale(film, large, DetectionSettings(cell_length_px=1.0))
