# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
import pytest

from memtrack import first_look
from memtrack.film import ArrayFilm, Film
from memtrack.models import load_model
from memtrack.nets import Nets
from memtrack.resampling import ScaledFilm
from memtrack.settings import DetectionSettings
from memtrack.stabilisation import FilmMotion
from memtrack.view import View

COUNT = 24


def film_of(width: float, contrast: float) -> ArrayFilm:
    """Round cells of a `width` (sigma) that run to and fro in noise."""
    rng = np.random.default_rng(2)
    y, x = np.mgrid[:260, :300].astype(np.float32)
    frames = rng.normal(100, 4, (COUNT, 260, 300)).astype(np.float32)
    for k in range(12):
        left, top = rng.uniform(30, [270, 230])
        for i in range(COUNT):
            swing = 4 * width * np.sin(i / 3 + k)
            frames[i] += contrast * np.exp(-((x - left - swing) ** 2 + (y - top) ** 2) / (2 * width**2))
    return ArrayFilm(np.clip(np.rint(frames), 0, 255).astype(np.uint8))


def fitted(film: Film) -> float:
    """The scale at which a film is seen."""

    def quiet(*of: int) -> None:
        pass

    model, settings = load_model(), DetectionSettings(threads=1)
    motion = FilmMotion(np.zeros((COUNT, 2)), np.ones(COUNT))
    view = View.of(film, 1.0, motion, model.card.features, report=quiet, alive=quiet, threads=1)
    return first_look.fitting(view, Nets.of(model, settings), settings.pruner(model.card), quiet, 1).scale


def test_a_film_of_cells_as_the_model_knows_them_is_seen_at_its_own_scale() -> None:
    assert fitted(film_of(2, 60)) == 1


def test_one_of_cells_four_times_as_wide_is_seen_smaller() -> None:
    assert fitted(film_of(8, 60)) < 0.6
    assert fitted(ScaledFilm(film_of(2, 60), 4)) < 0.6


def test_one_of_faint_cells_is_not_though_more_are_found_in_less_noise(monkeypatch: pytest.MonkeyPatch) -> None:
    faint = film_of(3.5, 5)
    assert fitted(faint) == 1
    monkeypatch.setattr(first_look, "BROAD", -np.inf)
    assert fitted(faint) < 1


def test_one_too_small_to_be_seen_smaller_is_seen_as_it_is() -> None:
    assert fitted(ArrayFilm(film_of(8, 60).frames[:, :100, :100])) == 1
