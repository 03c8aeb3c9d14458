# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np
import pytest

from memtrack.cuts import SceneChanges, ScenePart
from memtrack.film import ArrayFilm
from memtrack.simulation.scenes import mottled
from memtrack.stabilisation import measure_motion

COUNT, HEIGHT, WIDTH = 60, 150, 190


def gel(cut: int, *, jump: int = 0, lamp: float = 1.0, blur: float = 0.0) -> np.ndarray:
    """Grain that drifts by a pixel every five frames; from frame `cut` on out of focus, darker, or elsewhere."""
    rng = np.random.default_rng(5)
    scene = mottled(HEIGHT + 20, WIDTH + 20, 1.0, rng) * 15 + 100
    blurred = cv2.GaussianBlur(scene, (0, 0), blur) if blur else scene
    frames = []
    for i in range(COUNT):
        x = i // 5 + jump * (i >= cut)
        shown = (blurred * lamp if i >= cut else scene)[5 : 5 + HEIGHT, x : x + WIDTH]
        frames.append(shown + rng.normal(0, 2, shown.shape))
    return np.clip(np.rint(frames), 0, 255).astype(np.uint8)


def cuts(frames: np.ndarray) -> tuple[int, ...]:
    return measure_motion(ArrayFilm(frames), stabilise=True, report=lambda done, total: None).cuts


@pytest.mark.parametrize("cut", [20, 31, 40])
def test_a_jump_of_the_focus_cuts_the_scene_where_it_is(cut: int) -> None:
    assert cuts(gel(cut, blur=3.0)) == (cut,)


@pytest.mark.parametrize(
    "frames",
    [gel(30), gel(30, jump=6), gel(30, lamp=0.8), gel(12, blur=3.0), gel(50, blur=3.0)],
    ids=["drift", "jump of the stage", "lamp", "too near to the beginning", "too near to the end"],
)
def test_nothing_else_does(frames: np.ndarray) -> None:
    assert cuts(frames) == ()


def test_frames_without_light_are_no_cut() -> None:
    frames = gel(30)
    frames[28:31] //= 20
    assert cuts(frames) == ()


def test_what_does_not_show_all_of_the_part_is_passed_over() -> None:
    rng, changes = np.random.default_rng(0), SceneChanges()
    scenes = rng.normal(100, 10, (2, 60, 60)).astype(np.float32)
    for i in range(80):
        part = scenes[i // 40] + rng.normal(0, 1, (60, 60)).astype(np.float32)
        changes.add(i, part[: 60 - (i % 5 == 3)])
    assert changes.cuts(80) == (40,)


@pytest.mark.parametrize("shown", [range(80), range(30, 40)], ids=["all", "ten"])
def test_where_nothing_changes_or_too_little_is_seen_nothing_is_cut(shown: range) -> None:
    changes = SceneChanges()
    for i in shown:
        changes.add(i, np.zeros((60, 60), np.float32))
    assert changes.cuts(80) == ()


def test_a_part_of_the_scene_is_the_same_wherever_it_stands() -> None:
    scene = cv2.GaussianBlur(np.random.default_rng(0).normal(100, 20, (300, 340)), (0, 0), 3).astype(np.float32)
    film, drift = ArrayFilm(np.zeros((2, 200, 220), np.uint8)), np.array([[0.0, 0.0], [20.0, -12.0]])
    part = ScenePart.of(film, drift)
    first, second = (
        part.seen_in(scene[40 - y : 240 - y, 60 - x : 280 - x], d) for d in drift for x, y in [d.astype(int)]
    )
    assert first.shape == (160, 160)
    np.testing.assert_array_equal(first, second)
    assert min(part.seen_in(scene[:200, :220], np.array([150.5, 0.2])).shape) < 160
    assert part.seen_in(scene[:200, :220], np.array([900.5, 0.2])).size == 0


def test_a_scene_that_drifts_out_of_the_field_has_no_part_in_common() -> None:
    part = ScenePart.of(ArrayFilm(np.zeros((2, 60, 60), np.uint8)), np.array([[0.0, 0.0], [80.0, 0.0]]))
    assert part.size[0] == 0
    assert part.seen_in(np.zeros((60, 60), np.float32), np.array([80.0, 0.3])).size == 0
