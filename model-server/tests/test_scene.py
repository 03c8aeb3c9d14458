# SPDX-License-Identifier: GPL-3.0-or-later
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memtrack.background import temporal_background
from memtrack.channels import signed
from memtrack.errors import CancelledError
from memtrack.film import ArrayFilm, Calibration
from memtrack.motion import FeatureSpec, FilmFeatures
from memtrack.scene import Scene
from memtrack.stabilisation import FilmMotion
from memtrack.windows import Shots, Windows


def quiet(done: int, total: int) -> None:
    pass


def still(count: int) -> FilmMotion:
    return FilmMotion(np.zeros((count, 2)), np.ones(count))


def exchanged(count: int, height: int = 24, width: int = 32) -> np.ndarray:
    """A noisy film whose scene gives way to another in its middle."""
    rng = np.random.default_rng(0)
    scenes = rng.integers(80, 160, (2, height, width))
    frames = scenes[np.arange(count) * 2 // count] + rng.normal(0, 3, (count, height, width))
    return frames.round().astype(np.uint8)


@pytest.mark.parametrize(
    ("frames", "interval", "length", "count"),
    [
        (1, None, 1, 1),
        (900, 1 / 60, 900, 1),
        (901, None, 900, 2),
        (7200, 1 / 60, 900, 15),
        (7200, 2.0, 900, 15),
        (3200, 0.01, 1500, 4),
        (7200, 1e-3, 7200, 1),
    ],
)
def test_a_window_is_900_frames_or_15_seconds(frames: int, interval: float | None, length: int, count: int) -> None:
    film = ArrayFilm(np.zeros((frames, 1, 1), np.uint8), Calibration(None, interval))
    assert Shots.of(film, ()).windows == (Windows(frames, length, count),)


@given(st.integers(10, 60), st.integers(1, 400))
@settings(deadline=None, max_examples=30)
def test_windows_hold_the_frames_they_share_and_fade_into_each_other(length: int, frames: int) -> None:
    windows = Windows(frames, min(length, frames), max(1, -(-2 * frames // length) - 1))
    assert windows.window(0).start == 0
    assert windows.window(windows.count - 1).stop == frames
    shares = np.zeros((frames, windows.count))
    for frame in range(frames):
        for number, share in windows.near(frame):
            assert frame in windows.window(number)
            shares[frame, number] = share
    np.testing.assert_allclose(shares.sum(axis=1), 1)
    if windows.count > 1:
        assert np.abs(np.diff(shares, axis=0)).max() <= (windows.count - 1) / (frames - length) + 1e-9
    assert (np.diff(shares.argmax(axis=1)) >= 0).all()
    assert shares.max(axis=0).min() > 0.5


def test_a_short_film_has_the_background_of_the_whole() -> None:
    frames = exchanged(900)[:, :12, :16]
    film, motion = ArrayFilm(frames), still(900)
    whole = temporal_background(film, motion, report=quiet)
    scene = Scene(film, motion, report=quiet)
    grey, deviation, spread = FilmFeatures(scene, FeatureSpec("s", 1, ("grey", "deviation", "spread"))).frame(450)
    for index in (0, 450, 899):
        np.testing.assert_array_equal(scene.median(index), whole.median)
        np.testing.assert_array_equal(scene.spread(index), spread)
    texture = float(np.std(whole.median - scene.shading(0)))
    noise = float(np.linalg.norm([whole.noise, 0.03 * texture, 0.29]))
    np.testing.assert_array_equal(spread, signed(whole.spread / np.float32(noise) - 1))
    scale = np.float32(2 / np.hypot(texture, noise))
    np.testing.assert_array_equal(grey, signed((frames[450].astype(np.float32) - scene.shading(0)) * scale))
    assert deviation.std() > 0


def test_the_background_of_a_long_film_follows_its_scene() -> None:
    frames = exchanged(2400)
    film, motion = ArrayFilm(frames), still(2400)
    scene = Scene(film, motion, report=quiet)
    for index in (0, 300, 700, 1700, 2100, 2399):
        residue = frames[index] - scene.median(index)
        assert residue.std() < 3.6  # the noise of the film is 3
    assert 2.5 < scene.noise(0) < 3.6
    whole = temporal_background(film, motion, report=quiet)
    assert (frames[300] - whole.median).std() > 10


def test_backgrounds_change_without_a_jump() -> None:
    frames = exchanged(2100)
    scene = Scene(ArrayFilm(frames), still(2100), report=quiet)
    medians = np.stack([scene.median(i).copy() for i in range(0, 2100, 5)])
    noises = np.array([scene.noise(i) for i in range(0, 2100, 5)])
    steps = np.abs(np.diff(medians, axis=0)).max(axis=(1, 2))
    assert np.ptp(medians, axis=0).max() > 30
    assert steps.max() < 1.2 * 80 * 5 / 400  # at most 80 grey levels lie between the scenes, 400 frames between windows
    assert np.abs(np.diff(noises)).max() < 1.2 * 5 / 400 * np.ptp(noises)


def test_each_background_is_made_once_and_only_those_nearby_are_kept() -> None:
    frames = np.random.default_rng(0).integers(0, 255, (3000, 8, 8), np.uint8)
    drift = np.stack([0.2 * np.arange(3000), np.zeros(3000)], axis=1)
    reports: list[tuple[int, int]] = []
    later: list[int] = []
    scene = Scene(
        ArrayFilm(frames),
        FilmMotion(drift, np.ones(3000)),
        report=lambda *step: reports.append(step),
        alive=lambda: later.append(1),
    )
    assert reports == [(k + 1, 96) for k in range(96)]
    for index in range(0, 3000, 10):
        scene.median(min(index + 9, 2999))  # as features do: a coming frame's deviation, the current one's spread
        scene.spread(index)
        assert len(scene._stills) <= 4
        widest = max(s.background.median.shape[1] for s in scene._stills.values())
        assert widest <= 8 + 0.2 * 901  # what a window drifts, not what the film does
    assert len(later) == 5 * 96


def test_a_film_nobody_wants_any_more_is_left_in_the_middle_of_a_background() -> None:
    def alive() -> None:
        raise CancelledError("the caller no longer wants the result")

    scene = Scene(ArrayFilm(exchanged(1200)), still(1200), report=quiet, alive=alive)
    assert scene.median(449).shape == (24, 32)
    with pytest.raises(CancelledError):
        scene.median(460)


def test_each_shot_of_a_film_that_is_cut_has_a_background_of_its_own() -> None:
    film, motion = ArrayFilm(exchanged(80)), replace(still(80), cuts=(40,))
    scene = Scene(film, motion, report=quiet)
    for frames in (range(40), range(40, 80)):
        own = temporal_background(film, motion, report=quiet, frames=frames)
        for index in (frames[0], frames[-1]):
            np.testing.assert_array_equal(scene.median(index), own.median)


@given(st.integers(1, 2000), st.lists(st.integers(1, 5000), max_size=3, unique=True).map(sorted))
@settings(deadline=None, max_examples=30)
def test_windows_of_shots_are_numbered_through_and_hold_the_frames_they_share(last: int, cuts: list[int]) -> None:
    count = last + (cuts[-1] if cuts else 0)
    shots = Shots.of(ArrayFilm(np.zeros((count, 1, 1), np.uint8)), tuple(cuts))
    for frame in range(0, count, 97):
        near = shots.near(frame)
        assert sum(share for _, share in near) == pytest.approx(1)
        for number, _ in near:
            window = shots.window(number)
            assert frame in window
            assert not any(window.start < cut < window.stop for cut in cuts)
