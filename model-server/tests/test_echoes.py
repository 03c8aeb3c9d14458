# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen in neighbouring frames alone is no detection of this one."""

from dataclasses import replace

import numpy as np
import pytest

from memtrack.boxes import square_boxes
from memtrack.channels import NEUTRAL, Channel, signed
from memtrack.detections import Detections
from memtrack.echoes import NEIGHBOURS, without_echoes
from memtrack.models import load_model
from memtrack.nets import Nets
from memtrack.settings import DetectionSettings

NOISE = np.random.default_rng(1).normal(0, 1, (3, 80, 120)).astype(np.float32)


def spot(x: int, y: int, height: float, noise: np.ndarray) -> Channel:
    rows, columns = np.mgrid[:80, :120]
    return signed(noise + np.float32(height) * np.exp(-((columns - x) ** 2 + (rows - y) ** 2) / 8).astype(np.float32))


def boxes_at(*centres: tuple[float, float]) -> Detections:
    boxes = square_boxes(np.array(centres, np.float64).reshape(-1, 2), 30.0).astype(np.float32)
    return Detections(boxes, np.full(len(boxes), 0.9, np.float32), np.zeros(len(boxes), np.int8))


@pytest.mark.parametrize("height", [12, -12, 40])
def test_where_a_fast_bacterium_was_or_will_be_is_an_echo(height: float) -> None:
    before, now, after = spot(20, 40, height, NOISE[0]), spot(60, 40, height, NOISE[1]), spot(100, 40, height, NOISE[2])
    kept = without_echoes(boxes_at((20, 40), (60, 40), (100, 40)), now, [before, after])
    assert kept.centres.tolist() == [[60, 40]]


def test_a_slow_or_faint_bacterium_and_one_that_fades_are_none() -> None:
    slow = boxes_at((60, 40))
    assert len(
        without_echoes(slow, spot(60, 40, 12, NOISE[0]), [spot(57, 40, 12, NOISE[1]), spot(63, 40, 12, NOISE[2])])
    )
    fading = spot(60, 40, 5, NOISE[0])
    assert len(without_echoes(slow, fading, [spot(60, 40, 25, NOISE[1]), signed(NOISE[2])]))
    faint = spot(60, 40, 1, NOISE[0])
    assert len(without_echoes(slow, faint, [spot(60, 40, 1, NOISE[1]), spot(60, 40, 2, NOISE[2])]))


def test_boxes_at_the_edge_and_none_at_all() -> None:
    flat = np.full((80, 120), NEUTRAL, np.uint8)
    assert len(without_echoes(boxes_at((-0.5, -0.5), (119.5, 79.5)), flat, [flat])) == 2
    assert len(without_echoes(boxes_at(), flat, [flat, flat])) == 0


def test_the_shipped_model_takes_echoes_for_bacteria_and_they_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    model = load_model()
    names = model.card.features.channels
    assert set(NEIGHBOURS) <= set(names)
    nets = replace(Nets.of(model, DetectionSettings()), refiner=None)
    nothing = np.full((80, 120), NEUTRAL, np.uint8)

    def found(*shown: str) -> float:
        """Greatest score at a spot in some of the channels."""
        at = nets.candidates([spot(60, 40, 25, NOISE[0]) if name in shown else nothing for name in names])
        return float(at.scores[np.hypot(*(at.centres - (60, 40)).T) < 6].max(initial=0))

    assert found("deviation", "deviation-2") > 0.5
    assert found("deviation-2") == 0
    monkeypatch.setattr("memtrack.nets.without_echoes", lambda candidates, *_: candidates)
    assert found("deviation-2") > 0.5
