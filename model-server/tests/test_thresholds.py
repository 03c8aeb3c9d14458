# SPDX-License-Identifier: GPL-3.0-or-later
from dataclasses import replace

import numpy as np
import pytest

from memtrack.boxes import square_boxes
from memtrack.detections import Detections
from memtrack.training.thresholds import Scored, calibration, choose, curve, match


def found_at(*rows: tuple[float, float, float]) -> Detections:
    table = np.array(rows, np.float32).reshape(-1, 3)
    return Detections(square_boxes(table[:, :2], 30).astype(np.float32), table[:, 2], np.zeros(len(table), np.int8))


def test_matching_is_one_to_one_best_first_and_leaves_ignored_ones_out() -> None:
    truth = np.array([[50, 50, 1, 0], [100, 50, 0, 1]], np.float32)
    scores, _, right, error, level = match(found_at((53, 54, 0.9), (50, 50, 0.6), (101, 50, 0.8), (10, 10, 0.7)), truth)
    np.testing.assert_allclose(scores, [0.9, 0.6, 0.7])
    np.testing.assert_array_equal(right, [True, False, False])
    assert error[0] == pytest.approx(5)
    assert np.isnan(error[1:]).all()
    np.testing.assert_array_equal(level, [1, -1, -1])


def scored(scores: np.ndarray, found: np.ndarray, truths: int) -> Scored:
    n = len(scores)
    return Scored(
        scores.astype(np.float32),
        np.zeros(n, int),
        found,
        np.zeros(n),
        np.where(found, 0, -1),
        np.array([truths, 0, 0]),
        1,
    )


def test_precision_and_recall_by_hand() -> None:
    points = curve(scored(np.array([0.9, 0.8, 0.8, 0.3]), np.array([True, True, False, True]), 4))
    np.testing.assert_allclose(points.thresholds, [0.9, 0.8, 0.3])
    np.testing.assert_allclose(points.precision, [1, 2 / 3, 3 / 4])
    np.testing.assert_allclose(points.recall, [1 / 4, 2 / 4, 3 / 4])


def test_calibrated_scores_are_shares_of_right_ones() -> None:
    rng = np.random.default_rng(0)
    logits = rng.normal(0, 2, 20000)
    right = rng.random(20000) < 1 / (1 + np.exp(-(1.7 * logits - 0.6)))
    slope, offset = calibration((1 / (1 + np.exp(-logits))).astype(np.float32), right)
    assert slope == pytest.approx(1.7, abs=0.1)
    assert offset == pytest.approx(-0.6, abs=0.1)


def test_scores_stay_as_they_are_where_films_cannot_tell_what_they_are_worth() -> None:
    rng = np.random.default_rng(0)
    scores = rng.uniform(0.1, 0.9, 1000).astype(np.float32)
    few = np.arange(1000) < 19
    for right in (np.zeros(1000, bool), few, ~few, rng.random(1000) < 1 - scores, rng.random(1000) < 0.5):
        assert calibration(scores, right) == (1.0, 0.0)
    slope, _ = calibration(scores, rng.random(1000) < scores)
    assert slope == pytest.approx(1, abs=0.2)
    assert slope != 1


def test_one_probability_bounds_all_levels_and_maximum_precision_is_the_stricter_one() -> None:
    rng = np.random.default_rng(1)
    logits = rng.normal(0, 2, 9000)
    levels = rng.integers(0, 3, 9000)
    hidden = np.array([0.0, 1.5, -1.0])[levels]  # what a score of a level is worth
    right = rng.random(9000) < 1 / (1 + np.exp(-(2 * logits + hidden)))
    made = scored(1 / (1 + np.exp(-logits)), right, 5000)
    made = replace(made, levels=levels, true_level=np.where(right, levels, -1))
    chosen = choose(made)
    for criterion in ("max_precision", "max_f1"):
        worth = [2 * np.log(t / (1 - t)) + h for t, h in zip(chosen[criterion], (0.0, 1.5, -1.0), strict=True)]
        np.testing.assert_allclose(worth, np.mean(worth), atol=0.4)

    def judged(thresholds: tuple[float, ...]) -> tuple[float, float]:
        kept = made.scores >= np.array(thresholds)[levels]
        return float(right[kept].mean()), float((right & kept).sum() / 5000)

    strict, best = judged(chosen["max_precision"]), judged(chosen["max_f1"])
    assert strict[0] > best[0]
    assert strict[0] == pytest.approx(0.98, abs=0.005) or strict[1] < 0.8 * best[1]
    f1 = 2 * best[0] * best[1] / sum(best)
    for t in np.linspace(0.1, 0.9, 17):
        p, r = judged((t, t, t))
        assert f1 > 2 * p * r / (p + r) - 0.002


def test_of_bounds_with_even_f1_the_lowest_is_taken() -> None:
    scores = np.repeat([0.9, 0.6, 0.3, 0.1], [1000, 1000, 100, 1000])
    right = np.concatenate([np.arange(n) < of for n, of in ((1000, 1000), (1000, 800), (100, 40), (1000, 100))])
    bounds = (0.9, 0.6, 0.3, 0.1)
    f1 = [2 * right[scores >= t].sum() / ((scores >= t).sum() + 2000) for t in bounds]
    np.testing.assert_allclose(f1, [0.667, 0.9, 0.8976, 0.761], atol=5e-4)  # the best one is 0.6
    assert choose(scored(scores, right, 2000))["max_f1"][0] == pytest.approx(0.3, abs=0.02)


def test_without_a_detection_there_are_still_thresholds() -> None:
    assert choose(scored(np.zeros(0), np.zeros(0, bool), 4))["max_f1"] == pytest.approx((0.5, 0.5, 0.5))
