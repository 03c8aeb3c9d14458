# SPDX-License-Identifier: GPL-3.0-or-later
"""Bacteria that never move are found where they are asked for, and what only lies there is not."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from memtrack.background import Background, temporal_background
from memtrack.detections import Detections, FrameDetections
from memtrack.film import ArrayFilm
from memtrack.models import Model, load_model
from memtrack.pipeline import detect_film
from memtrack.resampling import ScaledFilm
from memtrack.resting import FEWEST, Looks, without_resting
from memtrack.scene import Scene
from memtrack.settings import DetectionSettings
from memtrack.simulation.film import simulate
from memtrack.simulation.optics import Look, draw
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait
from memtrack.stabilisation import FilmMotion

CELL = Look(length=8, width=4, contrast=-50, halo=0.15, halo_radius=10, flip=0, relief=0, relief_angle=0)
WATER = Recipe(width=256, height=224, frames=40, texture=1, read_noise=3, shot_noise=2)
RESTING = ((60, 40), (200, 60), (120, 180))
BEADS = ((50, 120), (210, 170))
SPECKS = ((130, 60), (30, 200), (180, 120))


def water(swimmers: int, resting: tuple[tuple[int, int], ...] = RESTING) -> ArrayFilm:
    """Dark bacteria that swim, others that rest, beads three times as dark, and bright specks."""
    made = simulate(replace(WATER, gaits=(Gait.SWIMMING,) * swimmers, looks=(CELL,) * swimmers), 3)
    lying = np.zeros((WATER.height, WATER.width), np.float32)
    bead = replace(CELL, length=7.0, width=7.0, contrast=-150.0)
    for places, look in ((resting, CELL), (BEADS, bead), (SPECKS, replace(CELL, contrast=50.0))):
        for k, (x, y) in enumerate(places):
            draw(lying, look, x, y, 0.8 * k, 0.0)
    return ArrayFilm(np.clip(made.film.frames + lying, 0, 255).astype(np.uint8))


def run(film: ArrayFilm, model: Model, **settings: object) -> tuple[list[FrameDetections], list[str]]:
    said = list[str]()
    wanted = DetectionSettings(**settings)  # type: ignore[arg-type]
    return list(detect_film(film, replace(model, crowds=None), wanted, lambda *_: None, said.append)), said


def seen(found: list[FrameDetections], place: tuple[float, float]) -> float:
    """Share of the frames with a detection there."""
    return float(np.mean([(np.hypot(*(f.detections.centres - place).T) < 3).any() for f in found]))


@pytest.fixture(scope="module")
def model() -> Model:
    return load_model()


def test_they_are_found_where_asked_for_and_beads_and_specks_are_not(model: Model) -> None:
    film = water(swimmers=10)
    found, said = run(film, model, resting=True)
    usual, nothing = run(film, model, resting=False)
    assert min(seen(found, place) for place in RESTING) > 0.9
    assert max(seen(found, place) for place in BEADS + SPECKS) < 0.2  # swimmers pass
    assert max(seen(usual, place) for place in RESTING) < 0.2
    assert len(said) == 1
    assert said[0].startswith("3 spot(s) that never move are as dark or as bright as the bacteria that move, ")
    assert not nothing


def test_a_film_at_another_scale_shows_the_same(model: Model) -> None:
    film = water(swimmers=10)
    larger = ScaledFilm(film, 2.5)
    found, said = run(ArrayFilm(np.stack([larger.frame(i) for i in range(40)])), model, resting=True, cell_length_px=20)
    assert said[0].startswith("3 spot(s) ")
    assert min(seen(found, (x * 2.5 + 0.75, y * 2.5 + 0.75)) for x, y in RESTING) > 0.9


def test_where_only_beads_and_specks_lie_none_is_found(model: Model) -> None:
    found, said = run(water(swimmers=10, resting=()), model, resting=True)
    assert max(seen(found, place) for place in RESTING + BEADS + SPECKS) < 0.2
    assert said == [
        "No resting bacteria were found: nothing that never moves is as dark or as bright as those that move."
    ]


def test_where_nothing_moves_nothing_tells_what_a_bacterium_looks_like(model: Model) -> None:
    found, said = run(water(swimmers=0), model, resting=True)
    assert not any(len(f.detections) for f in found)
    assert len(said) == 1
    assert said[0].startswith("No resting bacteria were looked for: too few move")


BLURRED = 4 / (4 + 1.2**2)
"""Height of a spot of sigma 2 px, in shares of its own, blurred by 1.2 px."""


def spots(*heights: float) -> np.ndarray:
    """An image of 200 x 60 pixels with spots of these heights, 30 pixels apart."""
    y, x = np.mgrid[:60, :200].astype(np.float32)
    return sum((h * np.exp(-((x - 25 - 30 * k) ** 2 + (y - 30) ** 2) / 8) for k, h in enumerate(heights)), 0 * x)


def boxes(count: int) -> Detections:
    centres = np.array([[25 + 30 * k, 30] for k in range(count)], np.float32).reshape(-1, 2)
    return Detections(
        np.concatenate([centres - 15, centres + 15], axis=1), np.ones(count, np.float32), np.zeros(count, np.int8)
    )


def test_looks_are_those_of_each_sign_with_room_to_both_sides() -> None:
    looks = Looks.of([(spots(-10, -12, 20, -14, 22), boxes(5))] * 5)
    assert looks is not None
    assert looks.heights[0] == pytest.approx(np.array([-14 * 1.2, -10 / 1.2]) * BLURRED, rel=0.1)
    assert looks.heights[1] == pytest.approx(np.array([20 / 1.2, 22 * 1.2]) * BLURRED, rel=0.1)


def test_too_few_of_a_sign_tell_nothing_of_it() -> None:
    dark_only = Looks.of([(spots(*[-10.0] * 5, 20.0), boxes(6))] * (FEWEST // 5))
    assert dark_only is not None
    assert np.isnan(dark_only.heights[1]).all()
    assert dark_only.fit(BLURRED * np.array([-10.0, 10.0, 20.0, -30.0])).tolist() == [True, False, False, False]
    hardly_any_bright = [(spots(*[-10.0] * 6), boxes(6))] * 20 + [(spots(*[-10.0] * 5, 20.0), boxes(6))] * FEWEST
    looks = Looks.of(hardly_any_bright)
    assert looks is not None
    assert np.isnan(looks.heights[1]).all()
    assert Looks.of([(spots(-10.0), boxes(1))] * (FEWEST - 1)) is None
    assert Looks.of([]) is None


def test_the_background_is_filled_where_they_rest_and_is_else_the_same() -> None:
    median = 120 + spots(-40, 30, -90, -44).astype(np.float32)
    background = Background(median, np.ones_like(median), (0, 0), 1.0)
    looks = Looks(np.array([[-34.0, -24.0], [np.nan, np.nan]]))
    after, count = without_resting(background, 1.0, looks)
    assert count == 2
    assert after.median[30, 25] == pytest.approx(120, abs=3)
    assert after.median[30, 115] == pytest.approx(120, abs=3)
    np.testing.assert_array_equal(after.median[:, 45:95], median[:, 45:95])
    same, none = without_resting(background, 1.0, Looks(np.array([[-10.0, -9.0], [np.nan, np.nan]])))
    assert same is background
    assert none == 0


def test_the_later_backgrounds_of_a_long_film_are_free_of_them_too() -> None:
    rng = np.random.default_rng(0)
    frames = np.clip(120 + spots(-40)[:, :60] + rng.normal(0, 2, (1000, 60, 60)), 0, 255).astype(np.uint8)
    film = ArrayFilm(frames)
    motion = FilmMotion(np.zeros((1000, 2)), np.ones(1000))
    scene = Scene(film, motion, report=lambda done, total: None)
    assert scene.median(0)[30, 25] < 85
    height = float(cv2.GaussianBlur(spots(-40), (0, 0), 1.2)[30, 25]) / scene.noise(0)
    assert scene.free_resting(Looks(np.array([[1.1 * height, 0.9 * height], [np.nan, np.nan]]))) == 1
    for frame in (0, 500, 999):
        assert scene.median(frame)[30, 25] == pytest.approx(120, abs=3)
    before = temporal_background(film, motion, report=lambda done, total: None)
    assert before.median[30, 25] < 85
