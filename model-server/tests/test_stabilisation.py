# SPDX-License-Identifier: GPL-3.0-or-later
from collections.abc import Callable

import cv2
import numpy as np
import pytest

from memtrack.errors import FilmError
from memtrack.film import ArrayFilm
from memtrack.registration import _block_shift, overlap
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import simulate
from memtrack.simulation.scenes import mottled
from memtrack.stabilisation import FilmMotion, measure_motion


def drifting(drift: np.ndarray, *, noise: float = 4.0, lamp: np.ndarray | None = None, cells: int = 0) -> ArrayFilm:
    """A mottled scene moved by `drift` (x, y), with noise, lamp and discs that swim through it."""
    rng = np.random.default_rng(5)
    scene = mottled(360, 420, 1.0, rng) * 18 + 117
    lamp = np.ones(len(drift)) if lamp is None else lamp
    places, steps = rng.uniform(0, [260, 220], (cells, 2)), rng.normal(0, 2, (cells, 2))
    frames = []
    for i, (dx, dy) in enumerate(drift):
        matrix = np.array([[1, 0, dx - 80], [0, 1, dy - 70]], np.float32)
        frame = cv2.warpAffine(scene, matrix, (260, 220), flags=cv2.INTER_LANCZOS4)
        for x, y in places + i * steps:
            cv2.circle(frame, (round(x), round(y)), 4, 240.0, -1)
        frames.append(np.clip(np.rint(frame * lamp[i] + rng.normal(0, noise, frame.shape)), 0, 255).astype(np.uint8))
    return ArrayFilm(np.stack(frames))


def measured(film: ArrayFilm) -> np.ndarray:
    return measure_motion(film, stabilise=True, report=lambda done, total: None).drift


def test_a_drift_of_several_pixels_is_found_to_a_twentieth_of_one() -> None:
    rng = np.random.default_rng(1)
    drift = np.cumsum(rng.normal([0.3, -0.1], 0.2, (25, 2)), axis=0)
    drift -= drift[0]
    error = measured(drifting(drift, cells=12)) - drift
    assert np.sqrt(np.square(error).mean()) < 0.08
    assert np.abs(error).max() < 0.2


def test_a_stage_that_jumps_is_followed() -> None:
    drift = np.zeros((12, 2))
    drift[5:] = [14.3, -9.6]
    np.testing.assert_allclose(measured(drifting(drift)), drift, atol=0.12)


def noise_alone(shape: tuple[int, int]) -> np.ndarray:
    return np.clip(np.random.default_rng(9).normal(8, 3, shape), 0, 255)


def another_place(shape: tuple[int, int]) -> np.ndarray:
    return np.clip(mottled(*shape, 1.0, np.random.default_rng(11)) * 18 + 117, 0, 255)


@pytest.mark.parametrize("dark", [[0], [0, 1, 2], [1], [14], [13, 14, 15], [29]], ids=str)
@pytest.mark.parametrize("shown", [np.zeros, lambda shape: np.full(shape, 255), noise_alone, another_place])
def test_frames_that_do_not_show_the_scene_do_not_disturb_the_others(
    dark: list[int], shown: Callable[[tuple[int, int]], np.ndarray]
) -> None:
    rng = np.random.default_rng(3)
    drift = np.cumsum(rng.normal([0.3, -0.2], 0.2, (30, 2)), axis=0)
    film = drifting(drift, cells=6)
    frames = np.stack([film.frame(i) for i in range(30)])
    frames[dark] = shown((film.height, film.width)).astype(np.uint8)
    error = measured(ArrayFilm(frames)) - drift
    error -= np.median(error, axis=0)
    assert np.abs(np.delete(error, dark, axis=0)).max() < 0.2
    assert np.abs(error[dark]).max() < 2  # between its neighbours


def test_a_scene_that_changes_and_wobbles_is_not_taken_for_a_stage_that_jumps() -> None:
    rng = np.random.default_rng(9_000_002)
    made = simulate(draw_recipe("collagen", rng, width=480, height=400, frames=int(rng.integers(60, 141))), 9_000_002)
    assert made.recipe.wobble > 0.3
    assert made.recipe.restless > 0.15
    assert np.abs(measured(made.film) - made.drift).max() < 0.5


def test_a_still_film_stays_still() -> None:
    assert np.abs(measured(drifting(np.zeros((10, 2)), cells=10))).max() < 0.1


def test_swimmers_in_front_of_nothing_are_no_drift() -> None:
    rng = np.random.default_rng(2)
    frames = np.full((20, 200, 240), 120.0) + rng.normal(0, 2, (20, 200, 240))
    for _ in range(20):
        place, step = rng.uniform(0, [240, 200]), rng.normal([1.5, 0.5], 1)
        for i in range(20):
            x, y = place + i * step
            cv2.circle(frames[i], (round(x), round(y)), 3, 60.0, -1)
    assert np.abs(measured(ArrayFilm(frames.astype(np.uint8)))).max() == 0


@pytest.mark.parametrize("seed", range(6))
def test_a_bright_swimmer_on_black_is_no_scene(seed: int) -> None:
    rng = np.random.default_rng(seed)
    frames = rng.normal(0, 1, (40, 200, 260))
    columns, rows = np.arange(260), np.arange(200)
    for place, angle in zip(rng.uniform([50, 40], [210, 160], (3, 2)), rng.uniform(0, 2 * np.pi, 3), strict=True):
        for i, frame in enumerate(frames):
            x, y = place + i * np.array([np.cos(angle), np.sin(angle)])
            frame += 60 * np.outer(np.exp(-np.square(rows - y) / 8), np.exp(-np.square(columns - x) / 8))
    motion = measure_motion(ArrayFilm(np.clip(frames, 0, 255).astype(np.uint8)), stabilise=True, report=lambda *_: None)
    assert not motion.drift.any()
    assert motion.unmeasured


def test_a_body_that_outshines_the_scene_does_not_hide_its_drift() -> None:
    rng = np.random.default_rng(3)
    drift = np.outer(np.arange(60), [0.1, -0.05])
    specks = rng.uniform(10, [250, 210], (40, 2))
    body = np.where(rng.random((5, 5)) < 0.5, 10.0, 190.0).repeat(6, axis=0).repeat(6, axis=1)
    columns, rows = np.arange(260), np.arange(220)
    frames = rng.normal(100, 2, (60, 220, 260))
    for i, frame in enumerate(frames):
        for x, y in specks + drift[i]:
            frame += 30 * np.outer(np.exp(-np.square(rows - y) / 12.5), np.exp(-np.square(columns - x) / 12.5))
        frame[80:110, 2 * i : 2 * i + 30] = body
    np.testing.assert_allclose(measured(ArrayFilm(frames.astype(np.uint8))), drift, atol=0.15)


def test_frames_without_their_background_share_no_scene() -> None:
    for seed in (7101, 7108, 7109):  # ones whose noise seems to drift, by 2 to 20 px
        recipe = draw_recipe("subtracted", np.random.default_rng(seed), width=320, height=320, frames=60)
        motion = measure_motion(simulate(recipe, seed).film, stabilise=True, report=lambda done, total: None)
        np.testing.assert_array_equal(motion.drift, 0)
        assert "share no scene" in motion.unmeasured


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_values_that_are_not_finite_are_refused(bad: float) -> None:
    frames = np.stack([drifting(np.zeros((3, 2))).frame(i) for i in range(3)]).astype(np.float32)
    frames[2, 7, 5] = bad
    told = "frame 3 of the 3 used holds values that are not finite .* NaN with .* > Remove NaNs"
    with pytest.raises(FilmError, match=told):
        measured(ArrayFilm(frames))


def test_one_dark_frame_leaves_the_gain_of_the_others() -> None:
    lamp = 1 + 0.05 * np.sin(np.arange(20.0))
    film = drifting(np.zeros((20, 2)), lamp=lamp)
    frames = np.stack([film.frame(i) for i in range(20)])
    frames[6] = 0
    motion = measure_motion(ArrayFilm(frames), stabilise=False, report=lambda done, total: None)
    assert motion.gain[6] == 1
    np.testing.assert_allclose(np.delete(motion.gain * lamp, 6), np.median(lamp), rtol=0.02)


def test_gain_undoes_the_flicker() -> None:
    lamp = 1 + 0.05 * np.sin(np.arange(10.0))
    film = drifting(np.zeros((10, 2)), lamp=lamp)
    motion = measure_motion(film, stabilise=False, report=lambda done, total: None)
    np.testing.assert_allclose(motion.gain * lamp, np.median(lamp), rtol=0.01)
    assert not motion.drift.any()
    assert not motion.unmeasured


def test_the_lamp_is_not_told_by_the_mean_of_a_film_less_its_background() -> None:
    less_background = np.random.default_rng(4).normal(0, 5, (40, 120, 160)).astype(np.float32)
    for offset, lit in ((0.3, False), (100.0, True)):
        motion = measure_motion(ArrayFilm(less_background + offset), stabilise=False, report=lambda *_: None)
        assert (motion.gain != 1).any() == lit
        assert not motion.unlit


def test_frames_are_sampled_evenly_from_the_lit_ones() -> None:
    motion = FilmMotion(np.zeros((12, 2)), np.ones(12), unlit=frozenset(range(4, 8)))
    assert motion.sampled(range(12), 4) == [0, 2, 8, 11]
    assert motion.sampled(range(2, 10), 9) == [2, 3, 8, 9]
    assert motion.sampled(range(4, 8), 2) == [4, 7]


@pytest.mark.parametrize("shape", [(1, 1, 1), (3, 1, 500), (2, 40, 40), (1, 300, 300)])
def test_films_too_small_to_register_have_no_drift(shape: tuple[int, int, int]) -> None:
    film = ArrayFilm(np.random.default_rng(0).integers(0, 255, shape, np.uint8))
    motion = measure_motion(film, stabilise=True, report=lambda done, total: None)
    assert not motion.drift.any()
    assert len(motion.gain) == shape[0]
    assert bool(motion.unmeasured) == (shape[0] > 1)


def test_every_frame_of_every_pass_is_reported() -> None:
    calls: list[tuple[int, int]] = []
    measure_motion(drifting(np.zeros((4, 2))), stabilise=True, report=lambda done, total: calls.append((done, total)))
    assert calls == [(k, 8) for k in range(1, 9)]


def test_overlapping_windows_show_the_same_places() -> None:
    still = np.arange(30).reshape(5, 6)
    moved = np.full((5, 6), -1)
    moved[2:, :3] = still[:3, 3:]  # the scene stands 3 px further left and 2 px further down
    target, source = overlap(still.shape, np.array([-3, 2]))
    np.testing.assert_array_equal(still[target], moved[source])
    assert still[target].shape == (3, 3)


def test_two_parts_of_a_black_field_that_move_in_different_ways_tell_no_shift() -> None:
    along_x, along_y = np.zeros((2, 96, 96), np.float32)
    along_x[:12, :12], along_y[24:36, 24:36] = 1, 1
    shift, error = _block_shift((along_x + along_y) * np.float32(1e-6), along_x, along_y)
    assert not shift.any()
    assert np.isinf(error)
