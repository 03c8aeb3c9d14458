# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np

from memtrack.film import ArrayFilm
from memtrack.fixed_pattern import fixed_pattern
from memtrack.scene import Scene
from memtrack.simulation.scenes import mottled
from memtrack.stabilisation import FilmMotion, measure_motion

SPECKS = ((60, 50), (140, 90))


def film_of(*, drift: float, dust: bool, cells: int = 0) -> ArrayFilm:
    """60 frames of a mottled scene that drifts to the right, with specks on the camera and cells that swim."""
    rng = np.random.default_rng(2)
    canvas = mottled(160, 320, 1.0, rng) * 15 + 120
    pattern = np.zeros((140, 200), np.float32)
    for x, y in SPECKS if dust else ():
        cv2.circle(pattern, (x, y), 3, -40.0, -1, cv2.LINE_AA)
    places, steps = rng.uniform(30, [170, 110], (cells, 2)), rng.normal(0, 0.7, (cells, 2))
    frames = []
    for i in range(60):
        matrix = np.array([[1, 0, drift * i - 60], [0, 1, -10]], np.float32)
        frame = cv2.warpAffine(canvas, matrix, (200, 140), flags=cv2.INTER_LANCZOS4) + pattern
        for x, y in places + i * steps:
            cv2.circle(frame, (round(x), round(y)), 3, 220.0, -1)
        frames.append(np.clip(np.rint(frame + rng.normal(0, 3, frame.shape)), 0, 255).astype(np.uint8))
    return ArrayFilm(np.stack(frames))


def pattern_of(film: ArrayFilm) -> tuple[np.ndarray | None, Scene, FilmMotion]:
    motion = measure_motion(film, stabilise=True, report=lambda done, total: None)
    scene = Scene(film, motion, report=lambda done, total: None)
    return scene.motion.pattern, scene, motion


def test_specks_on_the_camera_are_told_from_the_scene_that_drifts_behind_them() -> None:
    film = film_of(drift=0.3, dust=True)
    pattern, scene, measured = pattern_of(film)
    assert pattern is not None
    elsewhere = pattern.copy()
    for x, y in SPECKS:
        assert pattern[y, x] < -30
        elsewhere[y - 8 : y + 9, x - 8 : x + 9] = 0
    assert np.abs(elsewhere).max() < 10
    assert (elsewhere != 0).mean() < 0.02
    # The background holds no streak of a speck any more.
    clean = pattern_of(film_of(drift=0.3, dust=False))[1]
    np.testing.assert_allclose(scene.median(30)[20:-20, 30:-30], clean.median(30)[20:-20, 30:-30], atol=8)
    x, y = SPECKS[0]
    before, after = (m.corrected(film.frame(5).astype(np.float32), 5)[y, x] for m in (measured, scene.motion))
    assert after > before + 30


def test_a_clean_camera_has_no_pattern_whatever_swims() -> None:
    assert pattern_of(film_of(drift=0.3, dust=False, cells=12))[0] is None


def test_what_stands_still_with_the_scene_is_its_background() -> None:
    film = film_of(drift=0.0, dust=True)
    pattern, scene, motion = pattern_of(film)
    assert pattern is None
    assert fixed_pattern(film, motion, scene._stills[0].background, range(60)) is None
    assert scene.median(0)[50, 60] < scene.median(0)[50, 40:80].max() - 30
