# SPDX-License-Identifier: GPL-3.0-or-later
"""The training of the refining net, on crops around what the detector found in the training films. Needs torch."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import safetensors.torch
import torch
from jaxtyping import Float32, Int, UInt8
from torch import Tensor, nn

from memtrack.boxes import non_maximum_suppression
from memtrack.centre_net import CentreNet
from memtrack.detector import Decoder, Engine, detect
from memtrack.motion import FeatureSpec
from memtrack.refinement import EDGE_PX, LEAST_SCORE, crops_around
from memtrack.training.batches import inverted, signed_channels
from memtrack.training.config import Refinement
from memtrack.training.optimise import Report, computes_bfloat16, learn, schedule
from memtrack.training.samples import IGNORED, FilmSamples
from memtrack.training.thresholds import MATCH_PX

NUDGE_PX = 2
"""Crops are moved by up to this, so that what is learnt is where the bacterium is and not where the detector errs."""
NUDGE_SPREAD_PX = 0.8
LOG_SPREAD = (-3.0, 2.0)
"""Between 0.05 and 7 px: a few crops told exactly by chance must not outweigh all others."""


@dataclass(frozen=True, slots=True)
class CentreSamples:
    """Crops with `NUDGE_PX` around them, where the bacterium's centre (x, y) is from each one's centre pixel, and the
    number of each one's film."""

    crops: UInt8[np.ndarray, "n channel edge edge"]
    offsets: Float32[np.ndarray, "n 2"]
    films: Int[np.ndarray, " n"]


def centre_samples(films: Sequence[FilmSamples], engine: Engine, decoder: Decoder) -> CentreSamples:
    """A sample of each box that is the nearest to a bacterium, and it to the box, within `MATCH_PX`."""
    channels = films[0].features.shape[1]
    edge = EDGE_PX + 2 * NUDGE_PX
    crops, offsets = [np.empty((0, channels, edge, edge), np.uint8)], [np.empty((0, 2), np.float32)]
    owners = []
    for number, film in enumerate(films):
        for features, truth in zip(film.features, film.truth, strict=True):
            wanted = truth[truth[:, IGNORED] == 0, :2]
            if not len(wanted):
                continue
            found = detect(engine, decoder, np.ascontiguousarray(features))
            found = found.select(found.scores >= LEAST_SCORE)
            found = found.select(non_maximum_suppression(found.boxes, found.scores, 0.7))
            if not len(found):
                continue
            centres = found.centres
            distance = np.hypot(*(wanted[:, None] - centres[None]).transpose(2, 0, 1))
            nearest = distance.argmin(axis=1)
            own = (distance.min(axis=1) <= MATCH_PX) & (distance.argmin(axis=0)[nearest] == np.arange(len(wanted)))
            chosen = centres[nearest[own]]
            crops.append(crops_around(features, chosen, edge))
            offsets.append((wanted[own] - np.rint(chosen)).astype(np.float32))
            owners.append(np.full(len(chosen), number))
    return CentreSamples(np.concatenate(crops), np.concatenate(offsets), np.concatenate([np.empty(0, int), *owners]))


def optimise_centres(
    settings: Refinement,
    samples: CentreSamples,
    spec: FeatureSpec,
    device: str,
    report: Report,
    start: Path | None = None,
) -> nn.Module:
    """Trains a refining net on `samples`, each film as often as any other; returns its running mean.

    `start`: weights of a net like it to start from.

    Raises:
        SettingsError: the loss is no number any more.
    """
    torch.manual_seed(settings.seed)
    net = CentreNet(len(spec.channels), settings.widths)
    if start is not None:
        net.load_state_dict(safetensors.torch.load_file(start), strict=False)
    net = net.to(device).to(memory_format=torch.channels_last)
    keep = torch.optim.swa_utils.get_ema_multi_avg_fn(settings.average)  # type: ignore[no-untyped-call]
    average = torch.optim.swa_utils.AveragedModel(net, multi_avg_fn=keep, use_buffers=True)
    optimiser = torch.optim.AdamW(net.parameters(), lr=settings.learning_rate, weight_decay=settings.weight_decay)
    kind = device.split(":")[0]
    short = settings.bfloat16 and computes_bfloat16(kind)
    _, film, count = np.unique(samples.films, return_inverse=True, return_counts=True)
    chances = np.cumsum(1 / count[film])
    losses, started = [], time.monotonic()
    for iteration in range(settings.iterations):
        for group in optimiser.param_groups:
            group["lr"] = settings.learning_rate * schedule(iteration, settings)
        rng = np.random.default_rng([settings.seed, iteration])
        chosen = np.searchsorted(chances, rng.uniform(0, chances[-1], settings.batch))
        crops, offsets = augmented(samples.crops[chosen], samples.offsets[chosen], signed_channels(spec), rng)
        inputs = torch.from_numpy(crops).to(device, memory_format=torch.channels_last)
        with torch.autocast(kind, dtype=torch.bfloat16, enabled=short):
            out = net(inputs)
        loss = _loss(out.float(), torch.from_numpy(offsets).to(device))
        losses.append(learn(loss, net, average, optimiser, settings, iteration))
        if (done := iteration + 1) % 100 == 0 or done == settings.iterations:
            left = (time.monotonic() - started) / done * (settings.iterations - done)
            report(f"centres {done} of {settings.iterations}, loss {np.mean(losses):.4f}, {left / 60:.1f} min left")
            losses.clear()
    return average.module


def _loss(out: Tensor, offsets: Tensor) -> Tensor:
    """Minus the logarithm of the normal distribution around what the net says, as wide as it says: what no one can tell
    exactly has less of a say."""
    spread = out[:, 2].clamp(*LOG_SPREAD)
    squares = (out[:, :2] - offsets).square().sum(dim=1)
    return (squares * torch.exp(-2 * spread) / 2 + 2 * spread).mean()


def augmented(
    wide: UInt8[np.ndarray, "n channel wide wide"],
    offsets: Float32[np.ndarray, "n 2"],
    signed: np.ndarray,
    rng: np.random.Generator,
) -> tuple[UInt8[np.ndarray, "n channel edge edge"], Float32[np.ndarray, "n 2"]]:
    """Crops cut out of the `wide` ones near their middle, flipped and inverted at random."""
    count = len(wide)
    nudges = np.rint(rng.normal(0, NUDGE_SPREAD_PX, (count, 2))).clip(-NUDGE_PX, NUDGE_PX).astype(int)
    starts = nudges + NUDGE_PX
    crops = np.stack([w[:, y : y + EDGE_PX, x : x + EDGE_PX] for w, (x, y) in zip(wide, starts, strict=True)])
    offsets = offsets - nudges.astype(np.float32)
    left_right, up_down, swapped, dark = rng.random((4, count)) < 0.5
    # The edge is even, so a flip brings the centre pixel one beside its place.
    crops[left_right], offsets[left_right, 0] = crops[left_right, :, :, ::-1], -1 - offsets[left_right, 0]
    crops[up_down], offsets[up_down, 1] = crops[up_down, :, ::-1], -1 - offsets[up_down, 1]
    crops[swapped], offsets[swapped] = crops[swapped].transpose(0, 1, 3, 2), offsets[swapped][:, ::-1]
    crops[np.ix_(dark, signed)] = inverted(crops[np.ix_(dark, signed)])
    return crops, offsets
