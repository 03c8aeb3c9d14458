# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np
import pytest

from memtrack.channels import NEUTRAL
from memtrack.errors import SettingsError
from memtrack.film import ArrayFilm
from memtrack.flow import farneback_magnitude, lucas_kanade_magnitude
from memtrack.motion import AUTHORS, MOTION, PAPER, FeatureSpec, FilmFeatures
from memtrack.resampling import ScaledFilm, read_shifted
from memtrack.scene import Scene
from memtrack.simulation.scenes import mottled
from memtrack.stabilisation import FilmMotion, measure_motion


def features_of(frames: np.ndarray, spec: FeatureSpec, *, stabilise: bool = False) -> FilmFeatures:
    film = ArrayFilm(frames)
    motion = measure_motion(film, stabilise=stabilise, report=lambda done, total: None)
    return FilmFeatures(Scene(film, motion, report=lambda done, total: None), spec)


def noisy(count: int, h: int = 64, w: int = 80, level: float = 100.0) -> np.ndarray:
    rng = np.random.default_rng(0)
    return np.clip(rng.normal(level, 4, (count, h, w)), 0, 255).round().astype(np.uint8)


def test_a_bright_spot_is_a_positive_deviation_in_its_frame_and_a_dark_one_negative() -> None:
    frames = noisy(15)
    frames[7, 20:24, 30:34] += 60
    frames[7, 40:44, 50:54] -= 60
    made = features_of(frames, FeatureSpec("s", 1, ("deviation", "deviation-2", "deviation+2")))
    now, before, after = made.frame(7)
    assert now[21:23, 31:33].min() > NEUTRAL + 60
    assert now[41:43, 51:53].max() < NEUTRAL - 60
    assert np.abs(before[20:24, 30:34].mean() - NEUTRAL) < 15
    np.testing.assert_array_equal(made.frame(9)[1], now)
    np.testing.assert_array_equal(made.frame(5)[2], now)
    assert np.abs(after[20:24, 30:34].mean() - NEUTRAL) < 15


def test_a_frame_without_light_holds_nothing_and_its_neighbours_see_nothing_in_it() -> None:
    frames = noisy(30)
    frames[12] = 0
    made = features_of(frames, FeatureSpec("s", 1, ("grey", "deviation", "deviation-2", "deviation-8:-1")))
    assert (made.frame(12)[:2] == NEUTRAL).all()
    assert (made.frame(14)[2] == NEUTRAL).all()
    assert np.abs(made.frame(15)[3].mean() - NEUTRAL) < 5


def test_a_mean_of_deviations_shows_what_moves_slowly_and_is_less_noisy() -> None:
    frames = noisy(40)
    frames[20:28, 20:26, 30:36] += 8
    made = features_of(frames, FeatureSpec("s", 1, ("deviation", "deviation-8:-1", "deviation+1:+8")))
    now, before, after = made.frame(28).astype(float) - NEUTRAL
    assert before[20:26, 30:36].mean() > 30 > 5 > abs(now[20:26, 30:36].mean())
    assert before.std() < now.std()
    assert abs(after[20:26, 30:36].mean()) < 8
    assert (made.frame(0)[1] == NEUTRAL).all()  # nothing comes before the first frame
    assert (made.frame(39)[2] == NEUTRAL).all()


def test_deviations_are_in_units_of_the_noise() -> None:
    quiet, loud = (np.random.default_rng(1).normal(1000, sd, (40, 64, 64)) for sd in (5, 50))
    spreads = [
        features_of(f.round().astype(np.uint16), FeatureSpec("s", 1, ("deviation",))).frame(20).std()
        for f in (quiet, loud)
    ]
    assert spreads[0] == pytest.approx(spreads[1], rel=0.1)


def test_neighbours_of_a_drifting_film_are_brought_to_the_frames_place() -> None:
    rng = np.random.default_rng(2)
    scene = mottled(120, 200, 1.0, rng) * 15 + 110
    frames = np.stack([scene[10:110, 60 - 2 * i : 160 - 2 * i] for i in range(21)]) + rng.normal(0, 2, (21, 100, 100))
    frames[10, 48:52, 58:62] += 80
    drift = np.stack([2.0 * np.arange(21), np.zeros(21)], axis=1)
    film, motion = ArrayFilm(frames.astype(np.float32)), FilmMotion(drift, np.ones(21))
    still = Scene(film, motion, report=lambda done, total: None)
    made = FilmFeatures(still, FeatureSpec("s", 1, ("deviation", "deviation-2")))
    assert made.frame(10)[0, 49:51, 59:61].min() > NEUTRAL + 60
    assert made.frame(12)[1, 49:51, 63:65].min() > NEUTRAL + 60  # 2 frames later the place stands 4 px to the right
    assert (made.frame(20)[1, :, 96:] != NEUTRAL).any()
    assert (made.frame(20)[1, :, :4] == NEUTRAL).all()  # not in the field 2 frames before


def test_a_frame_has_the_same_features_in_a_film_gone_through_as_on_its_own() -> None:
    drift = np.stack([0.3 * np.arange(24), np.zeros(24)], axis=1)
    scene = Scene(ArrayFilm(noisy(24)), FilmMotion(drift, np.ones(24)), report=lambda done, total: None)
    forwards = FilmFeatures(scene, MOTION)
    for i in (*range(24), 11, 3, 4):
        np.testing.assert_array_equal(forwards.frame(i), FilmFeatures(scene, MOTION).frame(i))


def test_first_and_last_frame_have_features() -> None:
    made = features_of(noisy(4), MOTION)
    for i in range(4):
        assert made.frame(i).shape == (len(MOTION.channels), 64, 80)


@pytest.mark.parametrize("spec", [MOTION, PAPER, AUTHORS])
@pytest.mark.parametrize("shape", [(1, 1, 1), (2, 3, 70), (1, 33, 47)])
def test_every_spec_takes_the_smallest_films(spec: FeatureSpec, shape: tuple[int, int, int]) -> None:
    frames = np.random.default_rng(1).integers(0, 255, shape, np.uint8)
    features = features_of(frames, spec).frame(shape[0] - 1)
    assert features.shape == (len(spec.channels), *shape[1:])
    assert features.dtype == np.uint8


def test_a_constant_film_has_no_features() -> None:
    features = features_of(np.full((5, 40, 40), 77, np.uint8), MOTION).frame(2)
    assert (features[:6] == NEUTRAL).all()


def test_an_unknown_channel_is_refused_by_name() -> None:
    with pytest.raises(SettingsError, match="devation"):
        FeatureSpec("s", 1, ("grey", "devation"))


def test_lucas_kanade_measures_a_moved_texture_where_there_is_one() -> None:
    rng = np.random.default_rng(0)
    scene = (cv2.GaussianBlur(rng.normal(0, 1, (80, 120)), (0, 0), 2.5) * 200).astype(np.float32)
    scene[:, 60:] = 0
    moved = np.roll(scene, 1, axis=1)
    magnitude = lucas_kanade_magnitude(scene, moved, floor=0.5)
    assert np.median(magnitude[20:60, 15:45]) == pytest.approx(1.0, abs=0.15)
    assert magnitude[20:60, 80:110].max() < 0.05


def test_farneback_measures_a_moved_texture() -> None:
    rng = np.random.default_rng(0)
    scene = cv2.GaussianBlur(rng.normal(0, 1, (80, 120)), (0, 0), 2.5)
    scene = (128 + 40 * scene / scene.std()).astype(np.float32)
    magnitude = farneback_magnitude(scene, np.roll(scene, 2, axis=1))
    assert np.median(magnitude[20:60, 20:100]) == pytest.approx(2.0, abs=0.3)


def test_a_smooth_image_is_read_between_its_pixels() -> None:
    y, x = np.mgrid[:40, :50].astype(np.float32)
    image = np.sin(x / 4) + np.cos(y / 5)
    shifted = read_shifted(image, 0.3, -0.4)
    np.testing.assert_allclose(
        shifted[5:-5, 5:-5], (np.sin((x + 0.3) / 4) + np.cos((y - 0.4) / 5))[5:-5, 5:-5], atol=0.01
    )


def test_a_scaled_film_puts_pixels_where_it_says() -> None:
    frame = np.zeros((1, 40, 60), np.uint8)
    frame[0, 20:22, 30:32] = 200  # centre (30.5, 20.5)
    small = ScaledFilm(ArrayFilm(frame), 0.5).frame(0)
    y, x = np.unravel_index(small.argmax(), small.shape)
    assert (int(x), int(y)) == (15, 10)  # (30.5 + 0.5) * 0.5 - 0.5 = 15
