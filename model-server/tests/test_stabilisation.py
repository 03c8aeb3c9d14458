# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np
import pytest

from memtrack.film import ArrayFilm
from memtrack.simulation.scenes import mottled
from memtrack.stabilisation import measure_motion, overlap


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


def test_gain_undoes_the_flicker() -> None:
    lamp = 1 + 0.05 * np.sin(np.arange(10.0))
    film = drifting(np.zeros((10, 2)), lamp=lamp)
    motion = measure_motion(film, stabilise=False, report=lambda done, total: None)
    np.testing.assert_allclose(motion.gain * lamp, np.median(lamp), rtol=0.01)
    assert not motion.drift.any()


@pytest.mark.parametrize("shape", [(1, 1, 1), (3, 1, 500), (2, 40, 40), (1, 300, 300)])
def test_films_too_small_to_register_have_no_drift(shape: tuple[int, int, int]) -> None:
    film = ArrayFilm(np.random.default_rng(0).integers(0, 255, shape, np.uint8))
    motion = measure_motion(film, stabilise=True, report=lambda done, total: None)
    assert not motion.drift.any()
    assert len(motion.gain) == shape[0]


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
