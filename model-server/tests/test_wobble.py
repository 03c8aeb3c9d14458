# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np
import pytest

from memtrack.film import ArrayFilm
from memtrack.motion import FeatureSpec, FilmFeatures
from memtrack.scene import Scene
from memtrack.simulation.scenes import mottled
from memtrack.stabilisation import FilmMotion
from memtrack.wobble import COARSE, Slopes, take_out_wobble

SIZE = (240, 320)
NOISE = 2.0


def scene() -> np.ndarray:
    return mottled(*SIZE, 1.0, np.random.default_rng(0)) * np.float32(15) + np.float32(110)


def bent(image: np.ndarray, reach: float) -> np.ndarray:
    """`image` with each part displaced smoothly by up to about `reach` pixels."""
    y, x = np.mgrid[: SIZE[0], : SIZE[1]].astype(np.float32)
    right, down = (np.sin(x / a + y / b).astype(np.float32) * np.float32(reach) for a, b in ((60, 90), (80, -50)))
    return np.asarray(cv2.remap(image, x + right, y + down, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REFLECT))


def deviation(reach: float, *, cell: bool = False) -> np.ndarray:
    """Of a frame from its median, in units of the noise; a cell of 40 grey levels in its middle."""
    frame = bent(scene(), reach)
    if cell:
        cv2.circle(frame, (160, 120), 3, float(frame[120, 160]) + 40, -1, cv2.LINE_AA)
    noise = np.random.default_rng(1).normal(0, NOISE, SIZE).astype(np.float32)
    return np.asarray((frame + noise - scene()) / np.float32(NOISE))


@pytest.mark.parametrize("reach", [0.5, 0.8])
def test_what_a_bend_of_the_medium_explains_is_taken_out(reach: float) -> None:
    values = deviation(reach)
    assert values.std() > 1.15
    take_out_wobble(values, Slopes.of(scene(), NOISE))
    assert values.std() == pytest.approx(1, abs=0.03)


def test_a_cell_keeps_its_deviation() -> None:
    before = deviation(0.5, cell=True)
    after = before.copy()
    take_out_wobble(after, Slopes.of(scene(), NOISE))
    middle = np.s_[118:123, 158:163]
    assert before[middle].mean() > 10
    assert after[middle].mean() > 0.9 * deviation(0, cell=True)[middle].mean()


def test_where_the_medium_stands_still_nothing_changes_even_around_a_cell_that_moves_to_and_fro() -> None:
    median = np.full(SIZE, 110, np.float32)
    cv2.circle(median, (160, 120), 4, 150.0, -1, cv2.LINE_AA)  # it is in the median
    frame = np.full(SIZE, 110, np.float32)
    cv2.circle(frame, (161, 120), 4, 150.0, -1, cv2.LINE_AA)
    noise = np.random.default_rng(1).normal(0, NOISE, SIZE).astype(np.float32)
    before = (frame + noise - median) / np.float32(NOISE)
    after = before.copy()
    take_out_wobble(after, Slopes.of(median, NOISE))
    np.testing.assert_array_equal(after, before)


def test_noise_that_the_camera_smoothed_is_no_wobble() -> None:
    noise = cv2.GaussianBlur(np.random.default_rng(1).standard_normal(SIZE).astype(np.float32), (0, 0), 0.8)
    before = np.asarray(noise / noise.std(), np.float32)
    after = before.copy()
    take_out_wobble(after, Slopes.of(scene(), NOISE))
    np.testing.assert_array_equal(after, before)


def test_slopes_belong_to_the_part_of_the_scene_that_a_frame_shows() -> None:
    still = scene()
    count, size = 21, (200, 240)
    drift = np.stack([3.0 * np.arange(count), -1.0 * np.arange(count)], axis=1)
    parts = np.stack([still[10 + i : 210 + i, 70 - 3 * i : 310 - 3 * i] for i in range(count)])
    film = ArrayFilm(parts)
    made = Scene(film, FilmMotion(drift, np.ones(count)), report=lambda done, total: None)
    for i in (0, 20):
        seen, own = made.slopes(i), Slopes.of(parts[i], made.noise(i))
        inner = np.s_[4:-4, 4:-4]
        np.testing.assert_allclose(seen.slopes[0][inner], own.slopes[0][inner], atol=0.05 * own.slopes[0].std())
        assert seen.power[0].shape == own.power[0].shape == (size[0] // COARSE, size[1] // COARSE)
        middle = np.s_[6:-6, 6:-6]
        np.testing.assert_allclose(seen.power[0][middle], own.power[0][middle], rtol=0.25)


def test_the_features_of_a_wobbling_film_hold_little_of_its_wobble() -> None:
    rng = np.random.default_rng(3)
    reaches = 0.8 * np.sin(0.7 * np.arange(21))
    frames = np.stack([bent(scene(), reach) for reach in reaches]) + rng.normal(0, NOISE, (21, *SIZE))
    film = ArrayFilm(frames.astype(np.float32))
    made = Scene(film, FilmMotion(np.zeros((21, 2)), np.ones(21)), report=lambda done, total: None)
    most = int(np.abs(reaches).argmax())
    shown = FilmFeatures(made, FeatureSpec("s", 1, ("deviation",))).frame(most)[0].astype(np.float32)
    of_the_bend = bent(scene(), reaches[most]) - scene()
    left = np.corrcoef(shown.ravel(), of_the_bend.ravel())[0, 1]
    unchanged = np.corrcoef((frames[most] - made.median(most)).ravel(), of_the_bend.ravel())[0, 1]
    assert unchanged > 0.6
    assert abs(left) < 0.25


def test_a_frame_of_one_grey_level_stays_finite() -> None:
    values = np.zeros((5, 3), np.float32)
    take_out_wobble(values, Slopes.of(np.full((5, 3), 7, np.float32), 0.3))
    assert (values == 0).all()
