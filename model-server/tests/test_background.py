# SPDX-License-Identifier: GPL-3.0-or-later
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memtrack.background import Background, _order_statistics, aligned_frame, split_drift, temporal_background
from memtrack.film import ArrayFilm
from memtrack.stabilisation import FilmMotion, measure_motion


def still(count: int) -> FilmMotion:
    return FilmMotion(np.zeros((count, 2)), np.ones(count))


def background_of(frames: np.ndarray, motion: FilmMotion | None = None) -> Background:
    film = ArrayFilm(frames)
    return temporal_background(film, motion or still(len(frames)), report=lambda done, total: None)


def test_median_and_spread_of_a_five_by_five_film() -> None:
    frames = np.full((5, 5, 5), 100, np.uint8)
    frames[:, 2, 3] = [10, 20, 200, 40, 50]
    made = background_of(frames)
    assert made.median[2, 3] == pytest.approx(40, abs=0.01)
    assert np.abs(np.delete(made.median.ravel(), 13) - 100).max() < 0.01
    low, high = np.percentile(frames[:, 2, 3], [15.87, 84.13])
    assert made.spread[2, 3] == pytest.approx((high - low) / 2, rel=0.01)
    assert made.spread[0, 0] == 0


def test_frames_without_light_are_no_part_of_it() -> None:
    frames = np.full((20, 6, 8), 100, np.uint8)
    frames[5:17] = 2
    made = background_of(frames, replace(still(20), unlit=frozenset(range(5, 17))))
    np.testing.assert_allclose(made.median, 100, atol=0.01)


@settings(deadline=None)
@given(st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_order_statistics_equal_numpys(count: int, seed: int) -> None:
    stack = np.random.default_rng(seed).integers(0, 60000, (count, 4, 3), np.uint16)
    middle, width = _order_statistics(stack, 2)
    np.testing.assert_allclose(middle, np.median(stack, axis=0), rtol=1e-5)
    low, high = np.percentile(stack, [15.87, 84.13], axis=0)
    np.testing.assert_allclose(width, (high - low) / 2, rtol=1e-4, atol=0.5)


def test_the_canvas_holds_all_that_a_drifting_film_showed() -> None:
    scene = np.random.default_rng(0).integers(0, 255, (30, 40), np.uint8)
    # The scene moves right by 3 px a frame, so the field moves left over it.
    frames = np.stack([scene[5:15, 20 - 3 * i : 32 - 3 * i] for i in range(5)])
    drift = np.stack([3.0 * np.arange(5), np.zeros(5)], axis=1)
    made = background_of(frames, FilmMotion(drift, np.ones(5)))
    assert made.median.shape == (10, 24)
    assert made.origin == (-12, 0)
    np.testing.assert_allclose(made.median, scene[5:15, 8:32], atol=0.01)
    for i in range(5):
        np.testing.assert_allclose(made.median[made.window((3 * i, 0), 10, 12)], frames[i], atol=0.01)


def test_sixteen_bit_and_float_films_keep_their_range() -> None:
    rng = np.random.default_rng(3)
    for frames in (rng.integers(1000, 60000, (9, 6, 7), np.uint16), rng.normal(0, 1e-3, (9, 6, 7)).astype(np.float32)):
        exact = np.median(frames, axis=0)
        assert np.abs(background_of(frames).median - exact).max() < 3e-4 * float(np.ptp(frames))


@pytest.mark.parametrize("dtype", ["uint16", "float32"])
@pytest.mark.parametrize("always", [True, False], ids=["in every frame", "in one frame"])
def test_an_outlier_takes_nothing_from_the_rest(dtype: str, always: bool) -> None:
    frames = np.random.default_rng(3).normal(120, 2, (31, 20, 24))
    frames[slice(None) if always else 0, 7, 5] = 6e4 if dtype == "uint16" else 1e8
    film = frames.astype(dtype)
    made = background_of(film)
    np.testing.assert_allclose(made.median, np.median(film, axis=0), rtol=1e-6)
    low, high = np.percentile(film, [15.87, 84.13], axis=0)
    np.testing.assert_allclose(made.spread, (high - low) / 2, atol=0.01)


def test_places_that_no_frame_shows_are_as_bright_as_the_film() -> None:
    frames = np.random.default_rng(0).normal(30_000, 200, (5, 10, 12)).astype(np.uint16)
    drift = np.stack([2.0 * np.arange(5), 2.0 * np.arange(5)], axis=1)
    made = background_of(frames, FilmMotion(drift, np.ones(5)))
    assert made.median.shape == (18, 20)
    assert (made.spread[:2, 18:] == 0).all()
    assert np.abs(made.median - 30_000).max() < 1000


def test_strips_give_the_same_as_one_piece(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(4)
    frames = rng.integers(0, 255, (7, 23, 11), np.uint8)
    drift = rng.uniform(-2, 2, (7, 2))
    motion = FilmMotion(drift, rng.uniform(0.9, 1.1, 7), pattern=rng.normal(0, 9, (23, 11)).astype(np.float32))
    whole = background_of(frames, motion)
    monkeypatch.setattr("memtrack.background.STRIP_BYTES", 7 * 11 * 2 * 5)
    monkeypatch.setattr("memtrack.background.STRIP_BYTES_PER_PIXEL", 1)
    np.testing.assert_array_equal(background_of(frames, motion).median, whole.median)


def test_a_frame_is_read_as_often_whatever_its_size(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("memtrack.background.STRIP_BYTES", 1)
    read: list[int] = []

    class Counted(ArrayFilm):
        def frame(self, index: int) -> np.ndarray:
            read.append(index)
            return super().frame(index)

    for size in (48, 480):
        read.clear()
        temporal_background(Counted(np.zeros((96, size, size), np.uint8)), still(96), report=lambda done, total: None)
        assert {read.count(i) for i in range(1, 96)} == {3}


def test_highlights_in_which_the_camera_saturates_stand_still_while_the_lamp_drifts() -> None:
    scene = np.random.default_rng(5).normal(120, 15, (96, 96))
    scene[40:50, 40:50] = 290
    lamp = 1 + 0.08 * np.sin(np.arange(40) / 6)
    film = ArrayFilm(np.clip(np.rint(scene * lamp[:, None, None]), 0, 255).astype(np.uint8))
    motion = measure_motion(film, stabilise=False, report=lambda done, total: None)
    uncut = replace(motion, ceiling=math.inf)
    assert np.ptp([aligned_frame(film, uncut, i)[45, 45] for i in range(40)]) > 20
    assert np.ptp([aligned_frame(film, motion, i)[45, 45] for i in range(40)]) < 2
    dark = aligned_frame(film, uncut, 0) < 180
    np.testing.assert_array_equal(aligned_frame(film, motion, 0)[dark], aligned_frame(film, uncut, 0)[dark])


def test_a_few_flashes_do_not_flatten_a_film() -> None:
    frames = np.full((60, 32, 32), 100, np.uint8)
    frames[:, 10, 10] = 200
    frames[7] = 250
    film = ArrayFilm(frames)
    motion = measure_motion(film, stabilise=False, report=lambda done, total: None)
    assert aligned_frame(film, motion, 0)[10, 10] == pytest.approx(200, rel=0.01)


@given(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4))
def test_a_drift_is_its_whole_pixels_and_its_rest(x: float, y: float) -> None:
    whole, rest = split_drift(np.array([x, y]))
    assert np.abs(rest).max() <= 0.5
    np.testing.assert_allclose(np.add(whole, rest), [x, y], atol=1e-9)
