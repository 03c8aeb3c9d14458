# SPDX-License-Identifier: GPL-3.0-or-later
"""What the net's maps should be for a crop, and how far they are from it: focal loss, level, centre. Needs torch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from jaxtyping import Float32
from torch import Tensor
from torch.nn import functional

from memtrack.training.samples import IGNORED, LEVEL, X, Y


@dataclass(frozen=True, slots=True)
class LossSettings:
    """positive_px: places of the maps nearer than this to a centre answer for it, and the nearest one always.
    ring_px: up to here they are left out, beyond they must be silent. ignored_px: places around an ignored bacterium
    that are left out. gamma, alpha: of the focal loss. level_weight, centre_weight: of the two others.
    """

    positive_px: float = 3.0
    ring_px: float = 6.0
    ignored_px: float = 12.0
    gamma: float = 2.0
    alpha: float = 0.5
    level_weight: float = 0.1
    centre_weight: float = 1.0


def targets(
    truth: Float32[np.ndarray, "n 4"], height: int, width: int, stride: int, settings: LossSettings
) -> Float32[np.ndarray, "5 y x"]:
    """Maps for a crop whose bacteria are `truth`: presence, weight of it, level, and centre (x, y) in strides."""
    h, w = height // stride, width // stride
    out = np.zeros((5, h, w), np.float32)
    out[1] = 1
    if not len(truth):
        return out
    px = np.arange(w) * stride + (stride - 1) / 2
    py = np.arange(h) * stride + (stride - 1) / 2
    dx = truth[:, X, None, None] - px[None, None, :]
    dy = truth[:, Y, None, None] - py[None, :, None]
    distance = np.sqrt(dx * dx + dy * dy)
    ignored = truth[:, IGNORED] > 0
    wanted = np.where(ignored[:, None, None], np.inf, distance)
    nearest = wanted.argmin(axis=0)
    closest = np.take_along_axis(wanted, nearest[None], 0)[0]
    own_best = np.zeros((h, w), bool)
    for k in np.flatnonzero(~ignored):
        place = np.unravel_index(distance[k].argmin(), (h, w))
        if distance[k][place] < stride and nearest[place] == k:
            own_best[place] = True
    positive = (closest <= settings.positive_px) | own_best
    unsure = (closest <= settings.ring_px) | (
        np.where(ignored[:, None, None], distance, np.inf).min(0) <= settings.ignored_px
    )
    out[0] = positive
    out[1] = positive | ~unsure
    out[2] = truth[nearest, LEVEL]
    out[3] = np.take_along_axis(np.broadcast_to(dx, distance.shape), nearest[None], 0)[0] / stride
    out[4] = np.take_along_axis(np.broadcast_to(dy, distance.shape), nearest[None], 0)[0] / stride
    return out


def detection_loss(maps: Tensor, wanted: Tensor, settings: LossSettings) -> tuple[Tensor, Tensor]:
    """Mean over the bacteria of a batch, and each crop's share of the focal part (without gradient).

    `maps` [n, 1 + levels + 2, y, x], `wanted` [n, 5, y, x] from `targets`.
    """
    present, weight, level = wanted[:, 0], wanted[:, 1], wanted[:, 2].long()
    count = present.sum().clamp(min=8.0)
    logit = maps[:, 0]
    probability = torch.sigmoid(logit)
    entropy = functional.binary_cross_entropy_with_logits(logit, present, reduction="none")
    error = present * (1 - probability) + (1 - present) * probability
    balance = present * settings.alpha + (1 - present) * (1 - settings.alpha)
    focal = (weight * balance * error**settings.gamma * entropy).sum(dim=(1, 2))
    levels = (present * functional.cross_entropy(maps[:, 1:-2], level, reduction="none")).sum()
    off = functional.smooth_l1_loss(maps[:, -2:], wanted[:, 3:], beta=0.1, reduction="none").sum(dim=1)
    total = focal.sum() + settings.level_weight * levels + settings.centre_weight * (present * off).sum()
    return total / count, focal.detach()
