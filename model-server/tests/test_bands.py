# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
import pytest

from memtrack.bands import EvenFilm, without_bands
from memtrack.film import ArrayFilm
from memtrack.simulation.scenes import mottled

HEIGHT, WIDTH, NOISE = 80, 120, 2.0


def film(count: int = 24) -> np.ndarray:
    """Grain under uneven light that drifts by half a pixel a frame, with noise; a bright cell swims along the rows."""
    rng = np.random.default_rng(3)
    scene = mottled(HEIGHT, WIDTH + 20, 1.0, rng) * 8 + 100
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    lamp = 0.6 + 0.4 * x / WIDTH
    frames = []
    for i in range(count):
        cell = 60 * np.exp(-((x - 20 - 3 * i) ** 2 + (y - 40) ** 2) / 8)
        frames.append(lamp * (scene[:, i // 2 : i // 2 + WIDTH] + cell) + rng.normal(0, NOISE, (HEIGHT, WIDTH)))
    return np.stack(frames)


def banded(frames: np.ndarray, height: float, axis: int, roll: float = 7.0) -> np.ndarray:
    """With bands as high as this share of the light."""
    place, frame = np.arange(frames.shape[axis]), np.arange(len(frames))[:, None]
    light = 1 + height * np.sin(2 * np.pi * (place + roll * frame) / 40)
    return frames * np.expand_dims(light, 3 - axis)


def as_bytes(frames: np.ndarray) -> np.ndarray:
    return np.clip(np.rint(frames), 0, 255).astype(np.uint8)


@pytest.mark.parametrize("axis", [1, 2])
@pytest.mark.parametrize("roll", [3.0, 7.0, 20.0])
def test_bands_of_rows_and_of_columns_are_taken_out(axis: int, roll: float) -> None:
    clean = film()
    rolling = as_bytes(banded(clean, 0.03, axis, roll))
    even = without_bands(ArrayFilm(rolling))
    assert isinstance(even, EvenFilm)
    assert even.frame(0).dtype == np.uint8
    left = np.stack([even.frame(i) for i in range(len(clean))])
    assert _bands(left - clean, axis) < 0.45 * _bands(rolling - clean, axis)


def _bands(difference: np.ndarray, axis: int) -> float:
    """Standard deviation, within a frame, of what is common to a row or column."""
    shared = difference.mean(axis=3 - axis)
    return float((shared - shared.mean(axis=1, keepdims=True)).std())


def test_a_film_of_16_bits_and_one_of_floats_keep_their_types() -> None:
    for frames in ((banded(film(), 0.03, 1) * 100).astype(np.uint16), banded(film(), 0.03, 1).astype(np.float32)):
        even = without_bands(ArrayFilm(frames))
        assert isinstance(even, EvenFilm)
        assert even.frame(3).dtype == frames.dtype


def test_a_caption_stays_as_it_is_to_the_bit() -> None:
    captioned = as_bytes(banded(film(), 0.03, 1))
    captioned[:, 60:70, 80:110] = 250
    even = without_bands(ArrayFilm(captioned))
    assert isinstance(even, EvenFilm)
    assert {int(value) for i in range(5) for value in even.frame(i)[60:70, 80:110].ravel()} == {250}


@pytest.mark.parametrize(
    "frames",
    [
        film(),
        banded(film(), 0.002, 1),
        film() * (1 + 0.05 * np.sin(np.arange(24))[:, None, None]),
        film()[:7],
        np.full((24, HEIGHT, WIDTH), 7.0),
        np.zeros((24, HEIGHT, WIDTH)),
    ],
    ids=["drifting", "far below the noise", "flickering", "short", "of one grey", "black"],
)
def test_other_films_are_left_alone(frames: np.ndarray) -> None:
    whole = ArrayFilm(as_bytes(frames))
    assert without_bands(whole) is whole


def test_films_of_signed_or_hardly_any_light_are_left_alone() -> None:
    for level in (0.0, 5.0):
        whole = ArrayFilm((banded(film(), 0.03, 1) - film() + level).astype(np.float32))
        assert without_bands(whole) is whole


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_film_with_values_that_are_not_finite_is_left_to_those_who_refuse_it(bad: float) -> None:
    frames = film().astype(np.float32)
    frames[:, 9, 9] = bad
    whole = ArrayFilm(frames)
    assert without_bands(whole) is whole


def test_a_wall_that_trembles_is_no_band() -> None:
    frames = film()
    for i, frame in enumerate(frames):
        frame[20 + i % 2 : 23 + i % 2] += 60
    whole = ArrayFilm(as_bytes(frames))
    assert without_bands(whole) is whole
