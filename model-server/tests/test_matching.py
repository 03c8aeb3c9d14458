# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from memtrack.evaluation.assignment import assign
from memtrack.evaluation.curves import best_f1, precision_recall_curve
from memtrack.evaluation.matching import Counts, Criterion, compare
from memtrack.tracks import UNLINKED, TrackTable


def table(rows: list[tuple[int, float, float]], **columns: object) -> TrackTable:
    frames, x, y = np.array(rows, float).reshape(-1, 3).T
    return TrackTable.of(frames.astype(int), UNLINKED, x, y, **columns)  # type: ignore[arg-type]


@given(
    st.tuples(st.integers(0, 4), st.integers(0, 4)).flatmap(
        lambda shape: arrays(np.float64, shape, elements=st.sampled_from([0.0, 0.0, 0.1, 0.25, 0.5, 0.5, 1.0, -1.0]))
    )
)
def test_no_assignment_weighs_more(weights: np.ndarray) -> None:
    rows, columns = assign(weights)
    small, large = sorted(weights.shape)
    wide = weights if weights.shape[0] == small else weights.T
    best = max(
        sum(max(0.0, wide[i, j]) for i, j in enumerate(places))
        for places in itertools.permutations(range(large), small)
    )
    assert weights[rows, columns].sum() == pytest.approx(best)
    assert len(set(rows)) == len(rows) == len(set(columns)) == len(columns)
    assert (weights[rows, columns] > 0).all()
    assert rows.tolist() == sorted(rows)


def test_an_assignment_of_many_is_optimal() -> None:
    # Each row prefers the column of the row before it, but all together are best on the diagonal.
    n = 60
    weights = np.eye(n) * 1.0 + np.eye(n, k=-1) * 1.4
    rows, columns = assign(weights)
    assert weights[rows, columns].sum() == pytest.approx(1.4 * (n - 1))
    weights[0, n - 1] = 0.1
    rows, columns = assign(weights)
    assert weights[rows, columns].sum() == pytest.approx(1.4 * (n - 1) + 0.1)


def test_a_box_of_30_px_matches_up_to_an_overlap_of_a_tenth() -> None:
    # Shifted by d along x two boxes of 30 px overlap by (30 - d) / (30 + d), which is 0.1 at d = 24.545.
    truth = table([(0, 100, 100)])
    assert compare(truth, table([(0, 124.5, 100)]), Criterion()).counts == Counts(1, 0, 0)
    assert compare(truth, table([(0, 124.6, 100)]), Criterion()).counts == Counts(0, 1, 1)


def test_each_truth_has_one_prediction_and_each_prediction_one_truth() -> None:
    truth = table([(0, 10, 10), (0, 16, 10), (1, 50, 50)])
    predicted = table([(0, 12, 10), (0, 60, 60), (2, 50, 50)])
    counts = compare(truth, predicted, Criterion()).counts
    assert counts == Counts(tp=1, fp=2, fn=2)
    assert (counts.precision, counts.recall, counts.f1) == (1 / 3, 1 / 3, 1 / 3)


def test_as_many_pairs_as_possible_come_before_the_nearest_pair() -> None:
    truth = table([(0, 0, 0), (0, 5, 0)])
    predicted = table([(0, 4, 0), (0, 9, 0)])
    comparison = compare(truth, predicted, Criterion(distance_px=6))
    assert comparison.counts == Counts(2, 0, 0)


def test_distance_counts_below_the_gate_only() -> None:
    truth = table([(3, 1, 1), (3, 50, 50)])
    comparison = compare(truth, table([(3, 1, 6.9), (3, 50, 56)]), Criterion(distance_px=6))
    assert comparison.counts == Counts(1, 1, 1)
    assert comparison.pairs[0].similarity[0, 0] == pytest.approx(0.1 / 6)


def test_a_hit_on_an_ignored_truth_is_neither_right_nor_wrong() -> None:
    truth = table([(0, 10, 10), (0, 14, 10), (1, 10, 10)], ignored=[False, True, True])
    predicted = table([(0, 13, 10), (0, 15, 10), (0, 90, 90), (1, 11, 11), (2, 10, 10)])
    comparison = compare(truth, predicted, Criterion(distance_px=6))
    # (13, 10) is nearer to the ignored one but counts as the only hit of the real one.
    assert comparison.counts == Counts(tp=1, fp=2, fn=0)
    assert comparison.predicted.x.tolist() == [13, 90, 10]
    assert comparison.right.tolist() == [True, False, False]
    assert [pair.predictions.tolist() for pair in comparison.pairs] == [[0, 1], [2]]


def test_nothing_to_compare_has_no_precision_and_no_recall() -> None:
    nothing = table([])
    counts = compare(nothing, nothing, Criterion()).counts
    assert math.isnan(counts.precision)
    assert math.isnan(counts.recall)
    assert math.isnan(counts.f1)
    assert compare(nothing, table([(0, 1, 1)]), Criterion()).counts == Counts(0, 1, 0)
    assert compare(table([(0, 1, 1)]), nothing, Criterion()).counts == Counts(0, 0, 1)


def test_the_counts_do_not_depend_on_the_order_of_rows() -> None:
    rng = np.random.default_rng(7)
    truth = [(int(f), *xy) for f, xy in zip(rng.integers(0, 5, 40), rng.uniform(0, 100, (40, 2)).tolist(), strict=True)]
    found = [(int(f), *xy) for f, xy in zip(rng.integers(0, 5, 50), rng.uniform(0, 100, (50, 2)).tolist(), strict=True)]
    counts = compare(table(truth), table(found), Criterion()).counts
    assert counts.tp + counts.fn == 40
    assert counts.tp + counts.fp == 50
    assert compare(table(truth[::-1]), table(found[::-1]), Criterion()).counts == counts
    assert compare(table(found), table(truth), Criterion()).counts == Counts(counts.tp, counts.fn, counts.fp)


def test_the_curve_counts_what_each_threshold_leaves() -> None:
    truth = table([(0, 10, 10), (0, 60, 60), (1, 10, 10)])
    found = table([(0, 10, 10), (0, 60, 62), (0, 200, 200), (1, 300, 300)], scores=[0.9, 0.5, 0.4, 0.1])
    curve = {point.threshold: point.counts for point in precision_recall_curve([(truth, found)], Criterion())}
    assert curve[0.1] == Counts(2, 2, 1)
    assert curve[0.9] == Counts(1, 0, 2)
    best = best_f1(precision_recall_curve([(truth, found), (truth, found)], Criterion()))
    assert best.counts == Counts(4, 0, 2)
    assert 0.4 < best.threshold <= 0.5
    assert precision_recall_curve([(truth, table([]))], Criterion()) == []
