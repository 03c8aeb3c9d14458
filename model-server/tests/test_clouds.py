# SPDX-License-Identifier: GPL-3.0-or-later
import cv2
import numpy as np
import pytest

from memtrack.clouds import take_out_clouds
from memtrack.film import ArrayFilm
from memtrack.motion import FeatureSpec, FilmFeatures
from memtrack.scene import Scene
from memtrack.stabilisation import FilmMotion

NOISE, FRAMES, HEIGHT, WIDTH = 2.0, 40, 200, 260
SWIMMER = (131, 96)


def film_of(*, reach: float = 0.0, contrast: float = 0.0, noise: float = NOISE) -> ArrayFilm:
    """Noise, a scene, bodies of grain `reach` px that pass by fast, and a small swimmer at `SWIMMER` in frame 20."""
    rng = np.random.default_rng(5)
    scene = 110 + 6 * blurred(rng.normal(size=(HEIGHT, WIDTH)), 4)
    passing = blurred(rng.normal(size=(HEIGHT, WIDTH + 12 * FRAMES)), reach) if reach else np.zeros((HEIGHT, 2000))
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    frames = np.stack([scene + contrast * passing[:, 12 * i : 12 * i + WIDTH] for i in range(FRAMES)])
    frames[20] += 25 * np.exp(-((x - SWIMMER[0]) ** 2 / 12 + (y - SWIMMER[1]) ** 2 / 6))
    frames += rng.normal(0, noise, frames.shape)
    return ArrayFilm(np.clip(np.rint(frames), 0, 255).astype(np.uint8))


def blurred(image: np.ndarray, sigma: float) -> np.ndarray:
    smooth = cv2.GaussianBlur(image.astype(np.float32), (0, 0), sigma)
    return np.asarray(smooth / smooth.std())


def scene_of(film: ArrayFilm) -> Scene:
    return Scene(film, FilmMotion(np.zeros((FRAMES, 2)), np.ones(FRAMES)), report=lambda done, total: None)


def test_a_film_of_large_clouds_is_counted_in_units_of_what_changes_besides() -> None:
    scene = scene_of(film_of(reach=30, contrast=20))
    assert scene.clouded(0)
    assert NOISE * 0.9 < scene.noise(0) < 1.3 * NOISE
    deviation = FilmFeatures(scene, FeatureSpec("s", 1, ("deviation",))).deviation(20)
    x, y = SWIMMER
    assert deviation[y, x] > 0.5 * 25 / NOISE
    others = np.abs(deviation)
    others[y - 12 : y + 13, x - 12 : x + 13] = 0
    assert np.quantile(others, 0.999) < 0.7 * deviation[y, x]


@pytest.mark.parametrize(
    "film",
    [
        pytest.param({}, id="only noise"),
        pytest.param({"reach": 3, "contrast": 10}, id="bodies as small as bacteria"),
        pytest.param({"reach": 8, "contrast": 10}, id="bodies a few times as large"),
        pytest.param({"reach": 30, "contrast": 1}, id="clouds fainter than the noise"),
        pytest.param(
            {"reach": 30, "contrast": 0.8, "noise": 0.05}, id="less than rounding besides, as in packed films"
        ),
    ],
)
def test_a_film_is_not_clouded_where_there_is(film: dict[str, float]) -> None:
    scene = scene_of(film_of(**film))
    assert not scene.clouded(0)
    assert scene.noise(0) >= scene._stills[0].background.noise


def test_what_is_as_small_as_a_bacterium_stays_when_clouds_are_taken_out() -> None:
    y, x = np.mgrid[:120, :160].astype(np.float32)
    swimmer = 15 * np.exp(-((x - 80) ** 2 / 12 + (y - 60) ** 2 / 6))
    deviation = swimmer + 10 * np.sin(x / 40)
    take_out_clouds(deviation)
    assert deviation[60, 80] > 0.85 * 15
    assert np.abs(deviation[30:90, 30:130][swimmer[30:90, 30:130] < 0.1]).max() < 1.5
