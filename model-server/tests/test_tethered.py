# SPDX-License-Identifier: GPL-3.0-or-later
from typing import Any

import cv2
import numpy as np
import pytest

from memtrack.background import Background, temporal_background
from memtrack.film import ArrayFilm
from memtrack.scene import Scene
from memtrack.spots import SAMPLES, Spots
from memtrack.stabilisation import FilmMotion, measure_motion
from memtrack.tethered import without_tethered

NOISE = 2.0
HELD, DEBRIS = (60, 50), ((140, 90), (40, 110), (150, 30))
DEEPER = ((100, 25), (95, 105), (175, 62), (25, 25), (120, 60))
FRAMES = 80
FONT = cv2.FONT_HERSHEY_SIMPLEX


def film_of(
    *,
    wiggle: float,
    shake: float = 0.0,
    drift: float = 0.0,
    swimmers: int = 0,
    debris: bool = True,
    clock: bool = False,
    grain: float = 0.0,
    layers: bool = False,
    frames: int = FRAMES,
) -> ArrayFilm:
    """Water with a bacterium that wiggles in its place by `wiggle` px, debris that `shake` moves in one rhythm, more of
    it in a deeper layer with a rhythm of its own, a stage that drifts, swimmers that pass over the debris, and digits
    that run in place of some of it."""
    rng = np.random.default_rng(3)
    h, w = 140, 200
    texture = cv2.GaussianBlur(rng.normal(0, 1, (h, w + 60)).astype(np.float32), (0, 0), 3) * 10 * grain
    y, x = np.mgrid[:h, :w].astype(np.float32)
    rhythm, stacked = rng.normal(0, 1, frames), []
    deeper = np.random.default_rng(4).normal(0, 1, frames)
    for i in range(frames):
        left = round(drift * i)
        image = 120 + texture[:, 60 - left : 60 - left + w]
        places = [(np.add(HELD, rng.normal(0, wiggle, 2)), 40.0)]
        aside = np.multiply(shake * rhythm[i], [1, 0.5])
        places += [(place + aside, 40.0) for place in DEBRIS[clock:] if debris]
        places += [(place + np.multiply(shake * deeper[i], [-0.4, 1]), 40.0) for place in DEEPER if layers]
        places += [(np.array([(k * 40 + 3 * i) % 260 - 30, DEBRIS[k % 3][1]]), 60.0) for k in range(swimmers)]
        for (at_x, at_y), contrast in places:
            image = image + contrast * np.exp(-((x - at_x - left) ** 2 / 8 + (y - at_y) ** 2 / 5))
        if clock:
            digit = np.zeros((h, w), np.uint8)
            cv2.putText(
                digit, str(rng.integers(10)), (DEBRIS[0][0] - 4, DEBRIS[0][1] + 5), FONT, 0.4, 60, 1, cv2.LINE_AA
            )
            image = image + digit
        stacked.append(np.clip(np.rint(image + rng.normal(0, NOISE, (h, w))), 0, 255).astype(np.uint8))
    return ArrayFilm(np.stack(stacked))


def told(film: ArrayFilm, noise: float = NOISE) -> tuple[Background, Background, FilmMotion]:
    """The background before and after, and the film's motion."""
    motion = measure_motion(film, stabilise=True, report=lambda done, total: None)
    before = temporal_background(film, motion, report=lambda done, total: None)
    spots = Spots.of(before, noise)
    samples = spots.samples(before, film, motion, range(film.frame_count))
    return before, without_tethered(before, spots, samples, noise), motion


def heights(background: Background, debris: tuple[tuple[int, int], ...] = DEBRIS) -> list[float]:
    """How far the bacterium and the pieces of debris stand out of a background."""
    left, top = background.origin
    return [float(background.median[y - top, x - left]) - 120 for x, y in (HELD, *debris)]


@pytest.mark.parametrize("wiggle", [0.3, 0.6, 1.0])
def test_a_bacterium_that_wiggles_is_taken_out_and_debris_is_not(wiggle: float) -> None:
    before, after, _ = told(film_of(wiggle=wiggle))
    assert min(heights(before)) > 25
    assert abs(heights(after)[0]) < 3
    np.testing.assert_array_equal(heights(after)[1:], heights(before)[1:])
    np.testing.assert_array_equal(after.spread, before.spread)


@pytest.mark.parametrize(
    "film",
    [
        pytest.param({"wiggle": 0.0}, id="all stands still"),
        pytest.param({"wiggle": 0.0, "shake": 2.0}, id="the medium shakes debris by more than a pixel"),
        pytest.param({"wiggle": 0.0, "swimmers": 5}, id="swimmers pass over debris"),
        pytest.param({"wiggle": 0.0, "clock": True}, id="digits of a clock change"),
        pytest.param({"wiggle": 0.6, "grain": 10.0}, id="grain is as large as bacteria"),
        pytest.param({"wiggle": 0.6, "debris": False}, id="one that is alone may be shaken by the stage"),
        pytest.param({"wiggle": 1.0, "frames": 6}, id="a few frames do not tell"),
    ],
)
def test_the_background_is_the_same_where(film: dict[str, Any]) -> None:
    before, after, _ = told(film_of(**film))
    assert after is before


@pytest.mark.parametrize("layers", [False, True])
def test_what_the_medium_shakes_in_a_rhythm_of_its_layer_is_part_of_it(layers: bool) -> None:
    shaken, after, _ = told(film_of(wiggle=0.6, shake=0.7, layers=layers))
    debris = DEBRIS + DEEPER if layers else DEBRIS
    np.testing.assert_array_equal(heights(after, debris)[1:], heights(shaken, debris)[1:])
    assert abs(heights(after)[0]) < 3


def test_it_is_found_on_a_stage_that_drifts() -> None:
    before, after, motion = told(film_of(wiggle=0.6, drift=0.3, grain=1.0))
    assert motion.drift[-1, 0] == pytest.approx(0.3 * FRAMES, abs=2)
    assert heights(before)[0] > 25
    assert abs(heights(after)[0]) < 5
    np.testing.assert_allclose(heights(after)[1:], heights(before)[1:])


def test_films_of_floating_numbers_are_treated_alike() -> None:
    film = film_of(wiggle=0.6)
    whole, part = told(film)[1], told(ArrayFilm(film.frames.astype(np.float32) / 255), NOISE / 255)[1]
    np.testing.assert_allclose(part.median * 255, whole.median, atol=0.1)


def test_every_frame_that_is_read_is_told() -> None:
    film = film_of(wiggle=0.6)
    before, _, motion = told(film)
    calls: list[None] = []
    Spots.of(before, NOISE).samples(before, film, motion, range(film.frame_count), lambda: calls.append(None))
    assert len(calls) == SAMPLES


def test_the_scene_a_frame_is_compared_with_is_free_of_them() -> None:
    film = film_of(wiggle=0.6)
    motion = measure_motion(film, stabilise=True, report=lambda done, total: None)
    scene = Scene(film, motion, report=lambda done, total: None)
    x, y = HELD
    assert abs(float(scene.median(0)[y, x]) - 120) < 3
