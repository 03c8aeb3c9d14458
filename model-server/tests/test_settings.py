# SPDX-License-Identifier: GPL-3.0-or-later
"""What a film may be processed with."""

import pytest

from memtrack.errors import SettingsError
from memtrack.models import load_model
from memtrack.settings import DetectionSettings


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"criterion": "best"}, "criterion 'best' is unknown"),
        ({"thresholds": (0.5, 0.5, 1.5)}, "give 3 numbers from 0 to 1"),
        ({"max_size_px": 0.0}, "max_size_px is 0.0"),
        ({"nms_iou": -0.1}, "nms_iou is -0.1"),
        ({"cell_length_px": 0.5}, "cell_length_px is 0.5"),
        ({"threads": 0}, "threads is 0"),
        ({"engine": "warp"}, "engine 'warp' is unknown: use one of auto, openvino, torch"),
    ],
)
def test_settings_out_of_range_are_refused_with_their_value(settings: dict[str, object], message: str) -> None:
    with pytest.raises(SettingsError, match=message):
        DetectionSettings(**settings)  # type: ignore[arg-type]


def test_a_greatest_size_that_would_drop_every_box_of_the_model_is_refused() -> None:
    card = load_model().card
    for size in (20.0, 30.0):
        said = f"max_size_px is {size:g}, but all boxes of model default {card.version} have 30 pixels .* more than 30"
        with pytest.raises(SettingsError, match=said):
            DetectionSettings(max_size_px=size).pruner(card)
    assert DetectionSettings(max_size_px=30.5).pruner(card).max_size_px == 30.5
