# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from memtrack.boxes import square_boxes
from memtrack.detections import Detections
from memtrack.pruning import PrunerSettings, faint, prune


def detections(*rows: tuple[float, float, float, float, int]) -> Detections:
    """Rows x, y, size, score, level."""
    table = np.array(rows, np.float64).reshape(-1, 5)
    boxes = np.concatenate([square_boxes(row[None, :2], row[2]) for row in table]) if len(table) else np.zeros((0, 4))
    return Detections(boxes.astype(np.float32), table[:, 3].astype(np.float32), table[:, 4].astype(np.int8))


def test_each_filter_drops_its_own() -> None:
    candidates = detections(
        (50, 50, 30, 0.9, 0),
        (50, 150, 36, 0.9, 0),  # too large
        (150, 50, 30, 0.5, 1),  # below level 1's threshold, above level 0's
        (52, 50, 30, 0.8, 2),  # the first one again, found by another level
        (150, 150, 30, 0.7, 2),  # outside the region
        (58, 50, 30, 0.45, 0),  # a neighbour: IoU 0.58
    )
    region = np.ones((200, 200), bool)
    region[100:, 100:] = False
    kept, counts = prune(candidates, PrunerSettings((0.4, 0.6, 0.2)), region)
    np.testing.assert_allclose(kept.scores, [0.9, 0.45])
    np.testing.assert_allclose((kept.boxes[:, 0] + kept.boxes[:, 2]) / 2, [50, 58])
    assert (counts.candidates, counts.too_large, counts.near_misses) == (6, 1, 1)
    assert (counts.overlapping, counts.outside_region, counts.kept) == (1, 1, 2)


def test_a_box_of_exactly_the_limits_stays() -> None:
    kept, _ = prune(detections((50, 50, 35, 0.5, 0)), PrunerSettings((0.5, 1.0, 1.0)))
    assert len(kept) == 1


def test_nothing_in_nothing_out() -> None:
    kept, counts = prune(Detections.empty(), PrunerSettings((0.0, 0.0, 0.0)))
    assert len(kept) == 0
    assert counts.candidates == 0


def test_faint_boxes_are_those_that_only_the_threshold_drops() -> None:
    candidates = detections(
        (50, 50, 30, 0.5, 0),
        (51, 50, 30, 0.4, 0),  # overlaps a detection
        (50, 150, 30, 0.1, 0),
        (50, 150, 30, 0.2, 1),  # the same box, better
        (51, 150, 30, 0.15, 1),  # overlaps a better one
        (150, 50, 36, 0.2, 0),  # too large
        (150, 150, 30, 0.2, 0),  # outside the region
        (100, 20, 30, 0.3, 2),  # a detection: its level asks for less
    )
    region = np.ones((200, 200), bool)
    region[100:, 100:] = False
    settings = PrunerSettings((0.45, 0.45, 0.25))
    kept, _ = prune(candidates, settings, region)
    found = faint(candidates, kept, settings, region)
    np.testing.assert_allclose(kept.scores, [0.5, 0.3])
    np.testing.assert_allclose(found.scores, [0.2])
    np.testing.assert_allclose(found.boxes[0], [35, 135, 65, 165])
    assert len(faint(Detections.empty(), Detections.empty(), settings, region)) == 0


row = st.tuples(st.floats(0, 60), st.floats(0, 60), st.floats(10, 50), st.floats(0, 1, width=32), st.integers(0, 2))


@given(st.lists(row, max_size=12), st.tuples(*[st.floats(0, 1)] * 3), st.floats(0, 1))
def test_pruning_never_adds_and_its_counts_add_up(
    rows: list[tuple[float, float, float, float, int]], thresholds: tuple[float, float, float], iou: float
) -> None:
    candidates = detections(*rows)
    region = np.zeros((61, 61), bool)
    region[:, 20:] = True
    settings = PrunerSettings(thresholds, nms_iou=iou)
    kept, c = prune(candidates, settings, region)
    given_boxes = {tuple(box) for box in candidates.boxes.tolist()}
    assert all(tuple(box) in given_boxes for box in kept.boxes.tolist())
    assert c.candidates == len(rows)
    assert c.kept == len(kept)
    assert c.candidates == c.too_large + c.near_misses + c.overlapping + c.outside_region + c.kept
    again, _ = prune(kept, settings, region)
    np.testing.assert_array_equal(again.boxes, kept.boxes)
