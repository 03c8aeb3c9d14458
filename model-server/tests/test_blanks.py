# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np
import pytest

from memtrack.blanks import FilledFilm, without_blanks
from memtrack.film import ArrayFilm, Film
from memtrack.simulation.scenes import mottled

SHAPE = (120, 160)
Y, X = np.mgrid[: SHAPE[0], : SHAPE[1]]
ROUND = np.hypot(X - 80, Y - 60) > 56
BARS = (X < 20) | (X >= 150)


def film(count: int = 10, *, level: float = 110, lamp: float = 0.0) -> np.ndarray:
    """Grain with noise; a bright cell of 4 px swims to the right; the lamp dims by `lamp` over the film."""
    rng = np.random.default_rng(4)
    scene = mottled(*SHAPE, 1.0, rng) * 10 + level
    frames = []
    for i in range(count):
        cell = 80 * np.exp(-((X - 30 - 5 * i) ** 2 + (Y - 60) ** 2) / 8)
        frames.append((scene + cell + rng.normal(0, 2, SHAPE)) * (1 - lamp * i / count))
    return np.clip(np.rint(frames), 0, 255).astype(np.uint8)


def filled(of: Film) -> np.ndarray:
    """Which pixels are filled."""
    out = np.zeros((of.height, of.width), bool)
    found = without_blanks(of)
    if isinstance(found, FilledFilm):
        out[found.rows, found.columns] = True
    return out


@pytest.mark.parametrize("where", [ROUND, BARS], ids=["round field", "bars"])
@pytest.mark.parametrize("value", [0, 255])
def test_a_blank_part_is_filled_with_its_surroundings(where: np.ndarray, value: int) -> None:
    frames = film()
    frames[:, where] = value
    mended = without_blanks(ArrayFilm(frames)).frame(3)
    assert mended.dtype == np.uint8
    assert mended[where].min() > 85
    assert mended[where].max() < 135
    marked = filled(ArrayFilm(frames))
    assert marked[where].all()
    assert marked[~where].mean() < 0.06
    np.testing.assert_array_equal(mended[~marked], frames[3][~marked])


def test_what_is_lit_keeps_its_distance() -> None:
    frames = film()
    frames[:, BARS] = 0
    found = without_blanks(ArrayFilm(frames))
    assert isinstance(found, FilledFilm)
    lit = found.lit(6.0)
    assert not lit[:, :26].any()
    assert lit[:, 28:142].all()
    assert not lit[:, 144:].any()


def test_the_filling_dims_with_the_lamp() -> None:
    frames = film(lamp=0.3)
    frames[:, BARS] = 0
    mended = without_blanks(ArrayFilm(frames))
    first, last = (float(mended.frame(i)[BARS].mean()) for i in (0, 9))
    assert last / first == pytest.approx(1 - 0.3 * 0.9, abs=0.02)


def test_black_that_a_video_file_made_uneven_is_blank_too() -> None:
    frames = film()
    frames[:, BARS] = np.random.default_rng(5).integers(0, 4, (10, int(BARS.sum())))
    assert filled(ArrayFilm(frames))[BARS].all()


@pytest.mark.parametrize("dtype", [np.uint16, np.float32])
def test_deeper_images_are_filled_in_their_own_type(dtype: type) -> None:
    frames: np.ndarray = film().astype(dtype) * 16
    frames[:, ROUND] = 0
    mended = without_blanks(ArrayFilm(frames)).frame(0)
    assert mended.dtype == dtype
    assert mended[ROUND].min() > 85 * 16


@pytest.mark.parametrize(
    "frames",
    [
        film(),
        film(level=6),  # dark field: black nearly everywhere, without a step
        np.full((5, *SHAPE), 100, np.uint8),
        np.where((X < 6) & (Y < 6), 0, film()).astype(np.uint8),  # a corner
        np.where(np.hypot(X - 80, Y - 60) < 20, 0, film()).astype(np.uint8),  # inside the field: an object
        np.where(np.hypot(X - 80, Y - 60) > 30, 0, film()).astype(np.uint8),  # most of the frame
        np.full((3, *SHAPE), np.nan, np.float32),
        np.full((3, *SHAPE), np.inf, np.float32),
    ],
    ids=["grain", "dark field", "even", "corner", "object", "most", "nan", "infinity"],
)
def test_what_is_not_blank_is_left_alone(frames: np.ndarray) -> None:
    whole = ArrayFilm(frames)
    assert without_blanks(whole) is whole


def test_a_part_that_is_black_for_a_while_is_not_blank() -> None:
    frames = film()
    frames[:5, BARS] = 0
    whole = ArrayFilm(frames)
    assert without_blanks(whole) is whole


def written_on(frames: np.ndarray, value: int, *, seconds: float = 0.4) -> np.ndarray:
    """A scale bar at the lower left and a running clock at the upper right; which pixels either ever covers."""
    covered = np.zeros(SHAPE, bool)
    for i, frame in enumerate(frames):
        ink = np.zeros(SHAPE, np.uint8)
        cv2.rectangle(ink, (8, 108), (68, 110), 255, -1)
        cv2.putText(ink, f"{i * seconds:.1f} s", (100, 20), cv2.FONT_HERSHEY_SIMPLEX, 0.5, 255, 2)
        frame[ink > 0] = value
        covered |= ink > 0
    return covered


@pytest.mark.parametrize("value", [0, 255])
def test_a_scale_bar_and_a_running_clock_are_filled(value: int) -> None:
    frames = film(24)
    covered = written_on(frames, value)
    marked = filled(ArrayFilm(frames))
    assert marked[covered].all()
    assert marked.mean() < 3 * covered.mean()
    assert not marked[40:100].any()
    assert abs(without_blanks(ArrayFilm(frames)).frame(3)[covered].mean() - 110) < 15


def test_a_bright_fibre_or_a_bright_cell_is_no_scale_bar() -> None:
    frames = film(24)
    frames[:, 30:100, 40:43] = 255
    frames[:, 50:56, 90:98] = 255
    assert not filled(ArrayFilm(frames)).any()


def test_a_scene_that_saturates_keeps_what_saturates() -> None:
    frames = film(24)
    covered = written_on(frames, 255)
    blots = np.random.default_rng(0).integers([30, 10], [110, 110], (40, 2))
    for y, x in blots:
        frames[:, y : y + 7, x : x + 7] = 255
    assert not filled(ArrayFilm(frames)).any()
    assert covered.any()


def test_a_film_without_noise_does_not_tell_writing_by_what_stays_the_same() -> None:
    frames = np.repeat(film(1), 24, axis=0)
    written_on(frames, 255)
    assert not filled(ArrayFilm(frames)).any()
