# SPDX-License-Identifier: GPL-3.0-or-later
"""The nets: RetinaNet with one anchor a place, compact for CPUs or on torchvision's ResNet-50-FPN. Needs torch.

Every net maps uint8 features [n, channel, y, x], y and x multiples of `ALIGNMENT`, to float maps
[n, 1 + levels + 2, y / STRIDE, x / STRIDE]: the logit of "a bacterium of any level", one logit a level, and the
centre's distance from the place's own centre in units of the stride (x, y).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import torch
from torch import Tensor, nn

from memtrack.errors import SettingsError

ARCHITECTURES = ("compact", "resnet50_fpn")
ALIGNMENT = 16
STRIDE = 4
LEVELS = 3
OUTPUTS = 1 + LEVELS + 2
RARE = -4.6
"""Bias of a new classifier: bacteria are found in one place of a hundred (focal loss, Lin et al. 2017, pi = 0.01)."""


def convolution(inputs: int, outputs: int, stride: int = 1, size: int = 3) -> nn.Sequential:
    """A convolution, batch normalisation, and what is positive of it."""
    layer = nn.Conv2d(inputs, outputs, size, stride, size // 2, bias=False)
    return nn.Sequential(layer, nn.BatchNorm2d(outputs), nn.ReLU())


class _Residual(nn.Module):
    def __init__(self, width: int) -> None:
        super().__init__()
        self.first = convolution(width, width)
        self.second = nn.Sequential(nn.Conv2d(width, width, 3, 1, 1, bias=False), nn.BatchNorm2d(width))

    def forward(self, x: Tensor) -> Tensor:
        return torch.relu(x + self.second(self.first(x)))


class CompactRetinaNet(nn.Module):
    """A feature pyramid of strides 2, 4, 8 and 16 whose head looks at stride 4: small objects, exact centres.

    Args:
        channels: number of feature channels.
        widths: channels at the strides 2, 4, 8 and 16.
        depths: residual blocks at the strides 4, 8 and 16.
    """

    def __init__(self, channels: int, widths: tuple[int, ...], depths: tuple[int, ...]) -> None:
        super().__init__()
        w2, w4, w8, w16 = widths
        self.stem = nn.Sequential(convolution(channels, w2, 2), convolution(w2, w4, 2))
        self.at4 = nn.Sequential(*[_Residual(w4) for _ in range(depths[0])])
        self.at8 = nn.Sequential(convolution(w4, w8, 2), *[_Residual(w8) for _ in range(depths[1])])
        self.at16 = nn.Sequential(convolution(w8, w16, 2), *[_Residual(w16) for _ in range(depths[2])])
        self.lateral16 = nn.Conv2d(w16, w8, 1)
        self.lateral8 = convolution(w8, w4, size=1)
        self.merge = convolution(w4, w4)
        self.head = convolution(w4, w4)
        self.predict = nn.Conv2d(w4, OUTPUTS, 1)
        _start_silent(self.predict)

    def forward(self, features: Tensor) -> Tensor:
        """Output maps of uint8 `features`."""
        x = (features.float() - 128) / 32
        at4 = self.at4(self.stem(x))
        at8 = self.at8(at4)
        at8 = torch.relu(at8 + _double(self.lateral16(self.at16(at8))))
        maps: Tensor = self.predict(self.head(self.merge(at4 + _double(self.lateral8(at8)))))
        return maps


def _start_silent(predict: nn.Conv2d) -> None:
    nn.init.normal_(predict.weight, std=0.01)
    if predict.bias is not None:
        nn.init.zeros_(predict.bias)
        nn.init.constant_(predict.bias[:1], RARE)


def _double(x: Tensor) -> Tensor:
    return nn.functional.interpolate(x, scale_factor=2.0, mode="nearest")


class ResNet50Fpn(nn.Module):
    """torchvision's ResNet-50 with a feature pyramid, head on its stride-4 level: the paper's kind of net, for GPUs."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        from torchvision.models import resnet50  # type: ignore[import-untyped]
        from torchvision.models.detection.backbone_utils import BackboneWithFPN  # type: ignore[import-untyped]

        trunk = resnet50(weights=None)
        trunk.conv1 = nn.Conv2d(channels, 64, 7, 2, 3, bias=False)
        layers = {f"layer{i}": str(i) for i in range(1, 5)}
        self.trunk = BackboneWithFPN(trunk, layers, [256, 512, 1024, 2048], 256)
        self.head = nn.Sequential(*[convolution(256, 256) for _ in range(4)])
        self.predict = nn.Conv2d(256, OUTPUTS, 3, 1, 1)
        _start_silent(self.predict)

    def forward(self, features: Tensor) -> Tensor:
        """Output maps of uint8 `features`."""
        maps = self.trunk((features.float() - 128) / 32)
        out: Tensor = self.predict(self.head(maps["1"]))
        return out


Net = CompactRetinaNet | ResNet50Fpn


def build(architecture: Mapping[str, Any], channels: int) -> Net:
    """The net a card's or a configuration's `architecture` describes, with fresh weights.

    Raises:
        SettingsError: the architecture is unknown.
    """
    match architecture.get("name"):
        case "compact":
            return CompactRetinaNet(channels, tuple(architecture["widths"]), tuple(architecture["depths"]))
        case "resnet50_fpn":
            return ResNet50Fpn(channels)
        case other:
            raise SettingsError(f"architecture {other!r} is unknown: use one of {', '.join(ARCHITECTURES)}")
