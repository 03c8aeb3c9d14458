# SPDX-License-Identifier: GPL-3.0-or-later
import pytest
import torch

from memtrack.errors import SettingsError
from memtrack.retinanet import OUTPUTS, build


@pytest.mark.parametrize("architecture", [{"name": "compact", "widths": (4, 6, 8, 10), "depths": (1, 1, 1)}])
def test_the_compact_net_has_a_map_every_four_pixels(architecture: dict[str, object]) -> None:
    net = build(architecture, 3).eval()
    with torch.inference_mode():
        assert net(torch.zeros(2, 3, 48, 80, dtype=torch.uint8)).shape == (2, OUTPUTS, 12, 20)


def test_the_papers_kind_of_net_runs() -> None:
    pytest.importorskip("torchvision")
    net = build({"name": "resnet50_fpn"}, 3).eval()
    with torch.inference_mode():
        assert net(torch.zeros(1, 3, 64, 96, dtype=torch.uint8)).shape == (1, OUTPUTS, 16, 24)


def test_an_unknown_net_is_refused() -> None:
    with pytest.raises(SettingsError, match="architecture 'yolo' is unknown"):
        build({"name": "yolo"}, 3)
