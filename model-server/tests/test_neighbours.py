# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memtrack.neighbours import blocks, led_by_the_best


def taken(scores: list[float], places: list[float], reach: float) -> list[tuple[int, list[int]]]:
    at = np.array(places, np.float64)

    def near(rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        return np.abs(at[rows][:, None] - at[columns]) <= reach

    return [(i, followers.tolist()) for i, followers in led_by_the_best(np.array(scores, np.float64), at, reach, near)]


def test_the_best_takes_its_neighbours_and_the_next_best_what_is_left() -> None:
    assert taken([0.5, 0.9, 0.5, 0.4, 0.1], [1, 2, 4, 3, 9], 1.0) == [(1, [0, 1, 3]), (2, [2]), (4, [4])]
    assert taken([], [], 1.0) == []


def test_few_are_one_block_as_they_stand() -> None:
    [(rows, near)] = blocks(np.array([5.0, 1.0, 3.0]), 0.0, 3)
    assert (rows.tolist(), near.tolist()) == ([0, 1, 2], [0, 1, 2])


@given(st.lists(st.integers(0, 20), max_size=40), st.integers(1, 7), st.integers(0, 4))
def test_every_pair_within_reach_is_in_a_block_and_each_row_in_one(places: list[int], size: int, reach: int) -> None:
    at = np.array(places, np.float64)
    seen = [(r, set(near.tolist())) for rows, near in blocks(at, reach, size) for r in rows]
    assert sorted(r for r, _ in seen) == list(range(len(places)))
    for row, near in seen:
        assert set(np.flatnonzero(np.abs(at - at[row]) <= reach)) <= near


@given(st.lists(st.tuples(st.sampled_from([0.1, 0.5, 0.9]), st.integers(0, 20)), max_size=30), st.integers(0, 4))
def test_blocks_of_any_size_lead_to_the_same(rows: list[tuple[float, int]], reach: int) -> None:
    scores, places = [r[0] for r in rows], [float(r[1]) for r in rows]
    whole = taken(scores, places, reach)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("memtrack.neighbours.BLOCK", 3)
        assert taken(scores, places, reach) == whole
    assert sorted(i for _, followers in whole for i in followers) == list(range(len(rows)))
