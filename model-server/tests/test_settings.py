# SPDX-License-Identifier: GPL-3.0-or-later
"""What a film may be processed with."""

import pytest

from memtrack.errors import SettingsError
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
