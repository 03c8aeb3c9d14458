# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
import pytest

from memtrack.defects import RepairedFilm, without_defects
from memtrack.film import ArrayFilm, Film
from memtrack.simulation.scenes import mottled


def film(count: int = 12, *, swimmer: bool = False) -> np.ndarray:
    """Grain that drifts, with noise; a bright round cell of 4 px swims to the right, or rests."""
    rng = np.random.default_rng(2)
    scene = mottled(100, 150, 1.0, rng) * 12 + 100
    frames = []
    for i in range(count):
        frame = scene[10:90, 10 + i // 2 : 130 + i // 2] + rng.normal(0, 2, (80, 120))
        y, x = np.mgrid[:80, :120]
        for place in ((30.3 + 3 * i * swimmer, 40.6), (80.0, 60.0)):
            frame += 90 * np.exp(-((x - place[0]) ** 2 + (y - place[1]) ** 2) / (2 * 1.5**2))
        frames.append(np.clip(np.rint(frame), 0, 255).astype(np.uint8))
    return np.stack(frames)


def repaired(of: Film) -> set[tuple[int, int]]:
    found = without_defects(of)
    return (
        set(zip(found.rows.tolist(), found.columns.tolist(), strict=True)) if isinstance(found, RepairedFilm) else set()
    )


STUCK = [(0, 0), (0, 119), (79, 60), (12, 33), (50, 77)]


@pytest.mark.parametrize("value", [0, 255])
def test_pixels_that_are_stuck_are_replaced_by_those_around_them(value: int) -> None:
    clean = film()
    broken = clean.copy()
    for y, x in STUCK:
        broken[:, y, x] = value
    film_of_both = without_defects(ArrayFilm(broken))
    assert repaired(ArrayFilm(broken)) == set(STUCK)
    for i in (0, 7):
        mended = film_of_both.frame(i).astype(int)
        for y, x in STUCK:
            assert abs(mended[y, x] - int(clean[i, y, x])) < 15
            mended[y, x] = clean[i, y, x]
        np.testing.assert_array_equal(mended, clean[i])


def test_pixels_that_blink_are_replaced_too() -> None:
    broken = film(24)
    for i in range(0, 24, 3):
        for y, x in STUCK:
            broken[i, y, x] = 255
    assert repaired(ArrayFilm(broken)) == set(STUCK)


@pytest.mark.parametrize("swimmer", [False, True])
def test_bacteria_and_grain_are_no_defects(swimmer: bool) -> None:
    whole = ArrayFilm(film(swimmer=swimmer))
    assert without_defects(whole) is whole


def test_a_pixel_struck_once_is_left_alone() -> None:
    frames = film(24)
    frames[4, 20, 30] = 255
    assert not repaired(ArrayFilm(frames))


def test_an_image_full_of_spikes_is_of_that_kind() -> None:
    rng = np.random.default_rng(3)
    frames = np.full((10, 60, 60), 50, np.uint8)
    frames[:, rng.random((60, 60)) < 0.02] = 255
    assert not repaired(ArrayFilm(frames))


@pytest.mark.parametrize("dtype", [np.uint16, np.float32])
def test_deeper_images_are_repaired_in_their_own_type(dtype: type) -> None:
    frames: np.ndarray = film().astype(dtype) * 16
    frames[:, 12, 33] = 4095
    mended = without_defects(ArrayFilm(frames))
    assert repaired(ArrayFilm(frames)) == {(12, 33)}
    assert mended.frame(3).dtype == dtype


@pytest.mark.parametrize("shape", [(1, 40, 40), (5, 1, 9), (5, 2, 2)])
def test_films_too_small_to_tell_are_left_alone(shape: tuple[int, int, int]) -> None:
    small = ArrayFilm(np.random.default_rng(0).integers(0, 255, shape, np.uint8))
    assert without_defects(small) is small
