# SPDX-License-Identifier: GPL-3.0-or-later
"""Films with passing bodies, packed as a video, or with their background subtracted."""

from dataclasses import replace

import numpy as np
import pytest

from memtrack.simulation.film import SimulatedFilm, simulate
from memtrack.simulation.optics import Look
from memtrack.simulation.passing import passing_body
from memtrack.simulation.processing import through_video, without_background
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait

LOOK = Look(length=9, width=4, contrast=-80, halo=0.2, halo_radius=11, flip=0, relief=0, relief_angle=0)
PLAIN = Recipe(width=160, height=121, frames=20, gaits=(Gait.SWIMMING,) * 6, looks=(LOOK,) * 6)


def frames(of: SimulatedFilm) -> np.ndarray:
    return of.film.frames.astype(float)


def test_a_body_passes_through_the_field_and_is_no_truth() -> None:
    without, crossed = simulate(PLAIN, 3), simulate(replace(PLAIN, passing=1, passing_speed=4.0), 3)
    np.testing.assert_array_equal(crossed.truth.x, without.truth.x)
    changed = np.abs(frames(crossed) - frames(without)) > 6
    assert 0.01 < changed.mean() < 0.5
    assert changed.any(axis=0).mean() > 2 * changed.mean(axis=(1, 2)).max()  # it covers more places than it is large


def test_a_body_stands_where_its_path_and_the_drift_say() -> None:
    body = passing_body(300, 300, 10, 0.5, 50.0, 0.0, np.random.default_rng(1))
    drift = np.array([7.0, -3.0])
    near, moved = (np.zeros((300, 300), np.float32) for _ in range(2))
    body.draw(near, 4, np.zeros(2))
    body.draw(moved, 4, drift)
    np.testing.assert_allclose(moved[10:-10, 10:-10], np.roll(near, (-3, 7), (0, 1))[10:-10, 10:-10], atol=1e-3)
    assert np.abs(near).max() > 30


def test_a_video_keeps_the_cells_and_changes_the_noise() -> None:
    plain, packed = simulate(PLAIN, 5), simulate(replace(PLAIN, video=True), 5)
    assert packed.film.frames.shape == plain.film.frames.shape  # of odd height
    change = frames(packed) - frames(plain)
    assert 0.5 < change.std() < 6
    assert abs(change.mean()) < 4
    # What no one can tell from the noise of packing is no truth either.
    assert packed.truth.ignored.sum() >= plain.truth.ignored.sum()
    np.testing.assert_array_equal(through_video(plain.film.frames), through_video(plain.film.frames))


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_what_is_left_of_a_film_without_its_background_is_what_moves(dtype: type) -> None:
    still = np.tile(np.linspace(40, 200, 50), (8, 40, 1))
    cells = np.zeros_like(still)
    for i in range(8):
        cells[i, 20, 5 * i] = -30
    film: np.ndarray = (still + cells).astype(dtype)
    seen = set()
    for seed in range(30):
        left = without_background(film, -1, np.random.default_rng(seed)).astype(int)
        base = int(np.median(left))
        seen.add(base)
        for i in range(8):  # darker than the medium, and brighter afterwards
            assert left[i, 20, 5 * i] - base == pytest.approx(28, abs=3)
        assert np.abs(left - base).max(axis=0).mean() < 2  # the medium is gone
    assert seen == {0, 128 if dtype is np.uint8 else 2048}


def test_nothing_is_cut_off_where_bacteria_are_brighter_and_darker() -> None:
    film = np.full((8, 20, 20), 100, np.uint8)
    for i in range(8):
        film[i, 5, i], film[i, 9, i] = 140, 60
    for seed in range(30):
        left = without_background(film, 0, np.random.default_rng(seed)).astype(int)
        for i in range(8):
            assert abs(left[i, 5, i] - np.median(left)) > 25
            assert abs(left[i, 9, i] - np.median(left)) > 25
