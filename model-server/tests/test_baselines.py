# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import sys

import numpy as np
import pytest

from memtrack.errors import EngineUnavailableError
from memtrack.evaluation.baselines import detect, tune
from memtrack.evaluation.matching import Counts, Criterion
from memtrack.film import ArrayFilm
from memtrack.tracks import TrackTable


def film_of_spots(sign: float, rng: np.random.Generator) -> tuple[ArrayFilm, TrackTable]:
    """Ten frames with two moving Gaussian spots of sigma 2 px over a grainy still scene."""
    frames, truth = [], []
    y, x = np.mgrid[:80, :120]
    scene = 120 + 3 * np.sin(x / 5.0) * np.cos(y / 4.0)
    for t in range(10):
        centres = [(20.3 + 6 * t, 25.0), (95.0 - 5 * t, 60.6)]
        spots = sum(60 * np.exp(-((x - cx) ** 2 + (y - cy) ** 2) / 8) for cx, cy in centres)
        frames.append(scene + sign * spots + rng.normal(0, 1, scene.shape))
        truth += [(t, k, *centre) for k, centre in enumerate(centres)]
    t, k, cx, cy = np.array(truth).T
    return ArrayFilm(np.stack(frames).clip(0, 255).astype(np.uint8)), TrackTable.of(t, k, cx, cy)


@pytest.mark.parametrize("name", ["log", "log-deviation"])
@pytest.mark.parametrize("sign", ["bright", "dark"])
def test_a_baseline_finds_spots_to_a_fraction_of_a_pixel(name: str, sign: str) -> None:
    film, truth = film_of_spots(1.0 if sign == "bright" else -1.0, np.random.default_rng(1))
    for frame in detect(name, film, 3.0, sign, 20.0):
        best = frame.detections.boxes[:2]
        found = sorted(((best[:, 0] + best[:, 2]) / 2).tolist())
        assert found == pytest.approx(sorted(truth.x[truth.frames == frame.frame].tolist()), abs=0.25)
        assert best[:, 2] - best[:, 0] == pytest.approx([20, 20])


@pytest.mark.parametrize("name", ["log", "log-deviation", "trackpy"])
def test_a_film_of_fractions_has_the_spots_of_one_of_grey_levels(name: str) -> None:
    if name == "trackpy":
        pytest.importorskip("trackpy", reason="the extra 'baselines' is not installed")
    film, _ = film_of_spots(1.0, np.random.default_rng(1))
    low, high = film.frames.min(), film.frames.max()
    film = ArrayFilm(((film.frames - low) * (255 / (high - low))).round().astype(np.uint8))
    for scale in (1 / 255, 1e-9, 1e6):
        fractions = ArrayFilm((film.frames * scale).astype(np.float32))
        for ours, theirs in zip(detect(name, film, 4.0, "both"), detect(name, fractions, 4.0, "both"), strict=True):
            assert len(ours.detections) > 2
            np.testing.assert_allclose(theirs.detections.boxes[:2], ours.detections.boxes[:2], atol=0.2)
            np.testing.assert_allclose(theirs.detections.scores[:2], ours.detections.scores[:2], rtol=0.05)


def test_tuning_takes_the_sign_radius_and_threshold_that_serve_the_truth_best() -> None:
    film, truth = film_of_spots(-1.0, np.random.default_rng(2))
    best = tune("log-deviation", [(film, truth), (film, truth)], Criterion(distance_px=3))
    assert best.counts == Counts(40, 0, 0)
    assert best.sign in ("dark", "both")
    assert best.threshold > 0


def test_a_flat_film_has_no_spot() -> None:
    flat = ArrayFilm(np.full((3, 40, 50), 100, np.uint8))
    truth = TrackTable.of([0, 1], [0, 0], [5, 6], [5, 6], ignored=[False, True])
    assert [len(frame.detections) for frame in detect("log", flat, 3.0, "both")] == [0, 0, 0]
    assert tune("log", [(flat, truth)], Criterion()).counts == Counts(0, 0, 1)


def test_trackpy_finds_the_same_spots() -> None:
    pytest.importorskip("trackpy", reason="the extra 'baselines' is not installed")
    film, truth = film_of_spots(1.0, np.random.default_rng(3))
    frame = detect("trackpy", film, 4.0, "bright")[4]
    found = sorted(((frame.detections.boxes[:2, 0] + frame.detections.boxes[:2, 2]) / 2).tolist())
    assert found == pytest.approx(sorted(truth.x[truth.frames == 4].tolist()), abs=0.5)


def test_a_missing_trackpy_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "trackpy", None)
    film, _ = film_of_spots(1.0, np.random.default_rng(4))
    with pytest.raises(EngineUnavailableError, match="extra 'baselines'"):
        detect("trackpy", film, 4.0, "bright")
