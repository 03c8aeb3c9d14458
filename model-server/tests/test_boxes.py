# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from memtrack.boxes import areas, non_maximum_suppression, pairwise_iou, square_boxes

coordinates = st.floats(-50, 50, width=32)


def boxes(count: int) -> st.SearchStrategy[np.ndarray]:
    corners = arrays(np.float64, (count, 2), elements=coordinates)
    sizes = arrays(np.float64, (count, 2), elements=st.floats(0, 30, width=32))
    return st.tuples(corners, sizes).map(lambda pair: np.concatenate([pair[0], pair[0] + pair[1]], axis=1))


def test_iou_of_boxes_half_over_each_other() -> None:
    first, second = np.array([[0.0, 0, 4, 2]]), np.array([[2.0, 0, 6, 2]])
    assert pairwise_iou(first, second)[0, 0] == pytest.approx(4 / 12)


def test_empty_boxes_overlap_nothing() -> None:
    empty = np.array([[1.0, 1, 1, 1]])
    assert pairwise_iou(empty, empty)[0, 0] == 0


def test_areas_of_unequal_sides_and_of_one_inside_out() -> None:
    np.testing.assert_array_equal(areas(np.array([[0.0, 0, 3, 5], [4, 0, 2, 5]])), [15, 0])


def test_square_boxes_stand_around_their_centres() -> None:
    np.testing.assert_array_equal(square_boxes(np.array([[10.0, 20.0]]), 30), [[-5, 5, 25, 35]])


@given(boxes(4), boxes(3))
def test_iou_is_symmetric_and_a_share(first: np.ndarray, second: np.ndarray) -> None:
    overlaps = pairwise_iou(first, second)
    np.testing.assert_allclose(overlaps, pairwise_iou(second, first).T)
    assert ((overlaps >= 0) & (overlaps <= 1 + 1e-9)).all()


@given(boxes(7), arrays(np.float64, 7, elements=st.floats(0, 1)), st.floats(0.1, 0.9))
def test_suppression_is_idempotent_and_leaves_no_pair_over_the_limit(
    candidates: np.ndarray, scores: np.ndarray, iou: float
) -> None:
    kept = non_maximum_suppression(candidates, scores, iou)
    again = non_maximum_suppression(candidates[kept], scores[kept], iou)
    np.testing.assert_array_equal(again, np.arange(len(kept)))
    overlaps = pairwise_iou(candidates[kept], candidates[kept]) - np.eye(len(kept))
    assert (overlaps <= iou).all() or len(kept) == 1
    assert scores.max() == scores[kept[0]]


def test_suppression_keeps_a_box_that_only_a_suppressed_one_overlaps() -> None:
    row = np.array([[0.0, 0, 10, 10], [3, 0, 13, 10], [6, 0, 16, 10]])
    assert list(non_maximum_suppression(row, np.array([0.9, 0.8, 0.7]), 0.5)) == [0, 2]
