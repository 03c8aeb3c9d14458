# SPDX-License-Identifier: GPL-3.0-or-later
"""The contrast of a detection is that of its place."""

from __future__ import annotations

import numpy as np

from memtrack.boxes import square_boxes
from memtrack.channels import NEUTRAL, signed
from memtrack.contrast import WINDOW_PX, with_contrasts
from memtrack.detections import Detections, FrameDetections
from memtrack.messages import frame


def detections(*centres: tuple[float, float]) -> Detections:
    boxes = square_boxes(np.array(centres, float).reshape(-1, 2), 30).astype(np.float32)
    return Detections(boxes, np.full(len(boxes), 0.9, np.float32), np.zeros(len(boxes), np.int8))


def test_bright_and_dark_places_are_told_by_sign_and_size() -> None:
    deviation = np.zeros((80, 120), np.float32)
    deviation[14:27, 24:37] = 10  # ten times the noise: half of the scale
    deviation[54:67, 84:97] = -10
    found = with_contrasts(detections((30, 20), (90, 60), (90, 20)), signed(deviation))
    assert found.contrasts is not None
    np.testing.assert_allclose(found.contrasts, [0.5, -0.5, 0], atol=0.01)


def test_what_surrounds_a_small_one_counts() -> None:
    deviation = np.zeros((80, 120), np.float32)
    deviation[20, 30] = 1e6
    found = with_contrasts(detections((30, 20)), signed(deviation))
    assert found.contrasts is not None
    np.testing.assert_allclose(found.contrasts, [1 / WINDOW_PX**2], rtol=0.02)


def test_centres_at_the_edge_and_no_detections() -> None:
    deviation = np.full((40, 50), NEUTRAL + 64, np.uint8)
    found = with_contrasts(detections((-0.5, -0.5), (49.5, 39.5)), deviation)
    assert found.contrasts is not None
    np.testing.assert_allclose(found.contrasts, 64 / 127, atol=1e-6)
    none = with_contrasts(Detections.empty(), deviation)
    assert none.contrasts is not None
    assert none.contrasts.shape == (0,)


def test_contrasts_follow_their_boxes() -> None:
    found = with_contrasts(detections((30, 20), (90, 60)), signed(np.tile(np.arange(120, dtype=np.float32), (80, 1))))
    assert found.contrasts is not None
    chosen = found.select(np.array([1, 0]))
    assert chosen.contrasts is not None
    assert chosen.contrasts.tolist() == found.contrasts[::-1].tolist()
    assert chosen.contrasts[0] > chosen.contrasts[1] > 0


def test_a_contrast_that_was_not_measured_is_not_sent() -> None:
    found = detections((30, 20))
    (sent,) = frame(FrameDetections(0, found)).frame.detections
    assert not sent.HasField("contrast")
    (sent,) = frame(FrameDetections(0, with_contrasts(found, np.full((40, 50), NEUTRAL, np.uint8)))).frame.detections
    assert sent.HasField("contrast")
    assert abs(sent.contrast) < 1e-6
