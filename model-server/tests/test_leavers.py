# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np
import pytest

from memtrack.background import Background, temporal_background
from memtrack.film import ArrayFilm
from memtrack.leavers import without_leavers
from memtrack.models import load_model
from memtrack.pipeline import detect_film
from memtrack.settings import DetectionSettings
from memtrack.spots import Spots
from memtrack.stabilisation import FilmMotion

NOISE, FRAMES, HEIGHT, WIDTH = 2.0, 80, 140, 200
PLACE, DEBRIS = (60, 50), ((140, 90), (40, 110), (150, 30))
Y, X = np.mgrid[:HEIGHT, :WIDTH].astype(np.float32)


def medium(grain: float) -> np.ndarray:
    texture = np.random.default_rng(3).normal(0, 1, (HEIGHT, WIDTH)).astype(np.float32)
    return 120 + grain * 10 * cv2.GaussianBlur(texture, (0, 0), 3)


Way = list[tuple[float, float]]


def film_of(
    way: Way, *, grain: float = 0.0, size: float = 2.0, passing: bool = False, fading: bool = False
) -> ArrayFilm:
    """A body that goes its way, and debris; another body passes over it again and again, or all debris is gone in the
    last third."""
    rng, frames = np.random.default_rng(5), []
    for i, (x, y) in enumerate(way):
        image = medium(grain) + 40 * np.exp(-((X - x) ** 2 + (Y - y) ** 2) / (2 * size**2))
        for at_x, at_y in DEBRIS + tuple((20 + 18 * k, 125) for k in range(10)):
            if not (fading and i > 2 * FRAMES // 3):
                image += 40 * np.exp(-((X - at_x) ** 2 / 8 + (Y - at_y) ** 2 / 5))
        if passing and i % 12 < 4:
            image -= 40 * np.exp(-((X - DEBRIS[0][0]) ** 2 + (Y - DEBRIS[0][1]) ** 2) / 8)
        frames.append(np.clip(np.rint(image + rng.normal(0, NOISE, image.shape)), 0, 255).astype(np.uint8))
    return ArrayFilm(np.stack(frames))


def late(rest: int) -> Way:
    """It leaves its place after `rest` frames."""
    return [(PLACE[0] + 2.0 * max(0, i - rest), PLACE[1]) for i in range(FRAMES)]


def told(film: ArrayFilm) -> tuple[Background, Background, Spots]:
    """The background before and after, and the spots."""
    motion = FilmMotion(np.zeros((film.frame_count, 2)), np.ones(film.frame_count))
    before = temporal_background(film, motion, report=lambda done, total: None)
    spots = Spots.of(before, NOISE)
    return before, *without_leavers(before, spots, spots.samples(before, film, motion, range(film.frame_count)))


@pytest.mark.parametrize("grain", [0.0, 4.0])
@pytest.mark.parametrize("way", [late(48), late(68), late(48)[::-1]], ids=["leaves", "leaves late", "arrives"])
def test_what_is_behind_one_that_comes_or_goes_takes_its_place(way: Way, grain: float) -> None:
    before, after, spots = told(film_of(way, grain=grain))
    x, y = PLACE
    around = np.s_[y - 4 : y + 5, x - 4 : x + 5]
    assert before.median[y, x] > medium(grain)[y, x] + 25
    assert np.abs(after.median - medium(grain))[around].max() < 4
    elsewhere = np.hypot(X - x, Y - y) > 12
    np.testing.assert_array_equal(after.median[elsewhere], before.median[elsewhere])
    mine = (np.abs(spots.x - x) < 3) & (np.abs(spots.y - y) < 3)
    assert mine.any()
    assert not spots.clear[mine].any()


@pytest.mark.parametrize(
    "film",
    [
        film_of([PLACE] * FRAMES, passing=True),
        film_of(late(74)),
        film_of(late(48), size=12.0),
        film_of([PLACE] * FRAMES, fading=True),
        film_of(late(6)[:10]),
    ],
    ids=["others pass over debris", "leaves at the very end", "large body", "scene changes", "short film"],
)
def test_the_median_keeps_the_rest(film: ArrayFilm) -> None:
    before, after, _ = told(film)
    assert after is before


def test_a_robot_that_rests_at_first_is_found_in_all_frames_and_leaves_no_ghost() -> None:
    way = late(50)
    found = list(detect_film(film_of(way), load_model(), DetectionSettings(cell_length_px=7), lambda *_: None))
    error = [np.hypot(*(frame.detections.centres - place).T) for frame, place in zip(found, way, strict=True)]
    assert np.mean([near.min(initial=99) < 4 for near in error]) > 0.95
    assert sum((near > 8).sum() for near in error) == 0
