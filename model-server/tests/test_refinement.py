# SPDX-License-Identifier: GPL-3.0-or-later
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from memtrack.boxes import square_boxes
from memtrack.channels import NEUTRAL
from memtrack.detections import Detections
from memtrack.models import load_model
from memtrack.refinement import (
    DETECTOR_ERROR_PX,
    EDGE_PX,
    FURTHEST_PX,
    UNREFINED_ERROR_PX,
    Crops,
    Estimates,
    crops_around,
    refined,
)


class Saying:
    """A refiner that gives the same answer for every crop, or one told from the crops, and is nearly sure of it."""

    def __init__(self, answer: Callable[[Crops], np.ndarray] | list[float], spread: float = -9.0) -> None:
        self.answer, self.spread = answer, spread

    def estimates(self, crops: Crops) -> Estimates:
        said = self.answer(crops) if callable(self.answer) else np.tile(self.answer, (len(crops), 1))
        return np.column_stack([said, np.full(len(crops), self.spread)]).astype(np.float32)


def brightest(crops: Crops) -> np.ndarray:
    rows, columns = np.divmod(crops[:, 0].reshape(len(crops), -1).argmax(axis=1), EDGE_PX)
    return np.stack([columns, rows], axis=1) - EDGE_PX // 2


def boxes_at(*centres: tuple[float, float], scores: Sequence[float] = ()) -> Detections:
    boxes = square_boxes(np.array(centres, np.float64).reshape(-1, 2), 30.0).astype(np.float32)
    given = np.array(scores or [0.9] * len(boxes), np.float32)
    return Detections(boxes, given, np.zeros(len(boxes), np.int8))


def centres_of(found: Detections) -> np.ndarray:
    return found.centres


def test_a_crop_has_the_pixel_next_to_the_centre_in_its_middle_and_is_neutral_outside_the_frame() -> None:
    frame = np.random.default_rng(0).integers(0, 256, (2, 40, 60)).astype(np.uint8)
    inside, corner = crops_around(frame, np.array([[30.4, 20.6], [0.0, 39.0]]), EDGE_PX)
    half = EDGE_PX // 2
    np.testing.assert_array_equal(inside, frame[:, 21 - half : 21 + half, 30 - half : 30 + half])
    np.testing.assert_array_equal(corner[:, : half + 1, half:], frame[:, 39 - half :, :half])
    assert (corner[:, :, :half] == NEUTRAL).all()
    assert (corner[:, half + 1 :] == NEUTRAL).all()


def test_each_box_goes_to_where_the_refiner_sees_its_centre() -> None:
    frame = np.full((1, 80, 100), NEUTRAL, np.uint8)
    frame[0, 33, 21] = frame[0, 50, 72] = 255
    moved = refined(boxes_at((20.3, 31.8), (73.9, 51.2)), frame, Saying(brightest))
    np.testing.assert_allclose(centres_of(moved), [[21, 33], [72, 50]], atol=1e-4)
    np.testing.assert_allclose(moved.boxes[:, 2:] - moved.boxes[:, :2], 30, atol=1e-4)


def test_the_less_exact_the_refiner_is_the_more_the_detector_counts() -> None:
    frame = np.zeros((1, 80, 100), np.uint8)
    for error, share in ((DETECTOR_ERROR_PX, 0.5), (2 * DETECTOR_ERROR_PX, 0.2)):
        moved = refined(boxes_at((50, 40)), frame, Saying([1.0, -2.0], np.log(error)))
        np.testing.assert_allclose(centres_of(moved), [[50 + share, 40 - 2 * share]], atol=1e-4)


def test_boxes_that_share_a_centre_are_one_crop_and_stay_together() -> None:
    asked = []

    def answer(crops: Crops) -> np.ndarray:
        asked.append(len(crops))
        return np.tile([0.25, -0.5], (len(crops), 1))

    moved = refined(boxes_at((20, 30), (50, 40), (20, 30)), np.zeros((1, 80, 100), np.uint8), Saying(answer))
    np.testing.assert_allclose(centres_of(moved), [[20.25, 29.5], [50.25, 39.5], [20.25, 29.5]], atol=1e-4)
    assert asked == [2]


def test_each_box_has_the_error_that_the_refiner_expects() -> None:
    found = boxes_at((20, 30), (50, 40), (20, 30), (70, 60), scores=[0.9, 0.9, 0.9, 0.1])
    moved = refined(found, np.zeros((1, 80, 100), np.uint8), Saying([0.0, 0.0], np.log(0.25)))
    assert moved.errors is not None
    np.testing.assert_allclose(moved.errors, [0.25, 0.25, 0.25, UNREFINED_ERROR_PX], rtol=1e-6)
    chosen = moved.select(np.array([3, 0]))
    assert chosen.errors is not None
    assert chosen.errors.tolist() == moved.errors[[3, 0]].tolist()


def test_boxes_so_faint_that_nothing_was_learnt_of_them_stay() -> None:
    found = boxes_at((20, 30), (50, 40), (50, 40), scores=[0.1, 0.1, 0.2])
    moved = refined(found, np.zeros((1, 80, 100), np.uint8), Saying([1.0, 1.0]))
    np.testing.assert_allclose(centres_of(moved), [[20, 30], [51, 41], [51, 41]], atol=1e-4)


def test_no_centre_goes_far_or_out_of_the_frame() -> None:
    frame = np.zeros((1, 80, 100), np.uint8)
    moved = refined(boxes_at((50, 40), (98.5, 2)), frame, Saying([9.0, -9.0]))
    np.testing.assert_allclose(centres_of(moved), [[50 + FURTHEST_PX, 40 - FURTHEST_PX], [99.5, -0.5]], atol=1e-4)


def test_a_frame_without_boxes_asks_nothing() -> None:
    assert len(refined(boxes_at(), np.zeros((1, 80, 100), np.uint8), Saying([np.nan, np.nan]))) == 0


def test_both_refiners_of_the_shipped_model_agree() -> None:
    pytest.importorskip("torch")
    model = load_model()
    crops = np.random.default_rng(0).normal(NEUTRAL, 20, (5, len(model.card.features.channels), EDGE_PX, EDGE_PX))
    crops = crops.clip(0, 255).astype(np.uint8)
    quick, reference = model.refiner("openvino"), model.refiner("torch")
    assert quick is not None
    assert reference is not None
    np.testing.assert_allclose(quick.estimates(crops), reference.estimates(crops), atol=0.05)
    np.testing.assert_array_equal(quick.estimates(crops[:2]), quick.estimates(crops[:2]))


def test_a_model_without_a_refiner_has_none() -> None:
    assert load_model("default", "7").refiner() is None
