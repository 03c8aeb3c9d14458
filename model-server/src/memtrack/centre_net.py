# SPDX-License-Identifier: GPL-3.0-or-later
"""The refining net: from a crop of features around a box to where its bacterium's centre is. Needs torch."""

from __future__ import annotations

from torch import Tensor, nn

from memtrack.refinement import EDGE_PX
from memtrack.retinanet import convolution

HIDDEN = 64


class CentreNet(nn.Module):
    """Maps uint8 crops [n, channel, EDGE_PX, EDGE_PX] to [n, 3]: see `memtrack.refinement.Refiner.estimates`.

    Args:
        channels: number of feature channels.
        widths: channels at the strides 1, 2 and 4.
    """

    def __init__(self, channels: int, widths: tuple[int, int, int]) -> None:
        super().__init__()
        w1, w2, w4 = widths
        self.trunk = nn.Sequential(
            *(convolution(channels, w1), convolution(w1, w2, 2), convolution(w2, w2)),
            *(convolution(w2, w4, 2), convolution(w4, w4)),
        )
        self.hidden = nn.Sequential(nn.Flatten(), nn.Linear(w4 * (EDGE_PX // 4) ** 2, HIDDEN), nn.ReLU())
        self.predict = nn.Linear(HIDDEN, 3)
        nn.init.zeros_(self.predict.weight)
        nn.init.zeros_(self.predict.bias)

    def forward(self, crops: Tensor) -> Tensor:
        """Outputs of uint8 `crops`."""
        out: Tensor = self.predict(self.hidden(self.trunk((crops.float() - 128) / 32)))
        return out
