# SPDX-License-Identifier: GPL-3.0-or-later
"""A training from its recipe to a registered model: films, optimisation, calibration, thresholds, card. Needs torch."""

from __future__ import annotations

import csv
import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import nn

from memtrack.errors import ModelNotFoundError
from memtrack.models import load_model
from memtrack.motion import SPECS
from memtrack.retinanet import STRIDE, Net, build
from memtrack.training.batches import Batches
from memtrack.training.config import ModelSettings, Optimisation, TrainingConfig
from memtrack.training.figures import LOSSES
from memtrack.training.loss import detection_loss
from memtrack.training.samples import FilmSamples

Report = Callable[[str], None]
CHECKPOINT = "checkpoint.pt"


@dataclass(frozen=True, slots=True)
class Workspace:
    """Folder of one training, which can be interrupted and resumed: samples, checkpoint, loss curve, figures."""

    folder: Path

    @property
    def samples(self) -> Path:
        """Where samples of simulated films are kept."""
        return self.folder / "samples"


def architecture(model: ModelSettings) -> dict[str, object]:
    """The `architecture` entry of the model's card."""
    if model.architecture != "compact":
        return {"name": model.architecture}
    return {"name": "compact", "widths": list(model.widths), "depths": list(model.depths)}


def new_net(model: ModelSettings) -> Net:
    """The net to train: fresh, or with the weights of the model to start from."""
    channels = len(SPECS[model.features].channels)
    net = build(architecture(model), channels)
    if model.start_from:
        import safetensors.torch

        name, _, version = model.start_from.partition(" ")
        start = load_model(name, version or None)
        if start.card.features != SPECS[model.features] or start.card.architecture != architecture(model):
            raise ModelNotFoundError(
                f"model {model.start_from} has other features or another net than this training: start from one like it"
            )
        net.load_state_dict(safetensors.torch.load_file(start.weights), strict=False)
    return net


def optimise(
    config: TrainingConfig, films: list[FilmSamples], workspace: Workspace, device: str, report: Report
) -> nn.Module:
    """Trains the net; goes on from the workspace's checkpoint if there is one. Returns the averaged net."""
    settings = config.optimisation
    torch.manual_seed(settings.seed)
    net = new_net(config.model).to(device).to(memory_format=torch.channels_last)
    keep = torch.optim.swa_utils.get_ema_multi_avg_fn(settings.average)  # type: ignore[no-untyped-call]
    average = torch.optim.swa_utils.AveragedModel(net, multi_avg_fn=keep, use_buffers=True)
    decayed = [p for p in net.parameters() if p.ndim > 1]
    plain = [p for p in net.parameters() if p.ndim <= 1]
    groups = [{"params": decayed, "weight_decay": settings.weight_decay}, {"params": plain, "weight_decay": 0.0}]
    optimiser = torch.optim.AdamW(groups, lr=settings.learning_rate)
    batches = Batches(
        films,
        SPECS[config.model.features],
        crop=settings.crop,
        size=settings.batch,
        stride=STRIDE,
        loss=config.loss,
    )
    first = _resume(workspace, net, average, optimiser, batches)
    losses: list[float] = []
    started = time.monotonic()
    for iteration in range(first, settings.iterations):
        rate = settings.learning_rate * schedule(iteration, settings)
        for group in optimiser.param_groups:
            group["lr"] = rate
        # Seeded by its number, so that a resumed training draws what an uninterrupted one would have drawn.
        features, wanted, chosen = batches.draw(np.random.default_rng([settings.seed, iteration]))
        inputs = torch.from_numpy(features).to(device, memory_format=torch.channels_last)
        with torch.autocast(device.split(":")[0], dtype=torch.bfloat16, enabled=settings.bfloat16):
            maps = net(inputs)
        loss, shares = detection_loss(maps.float(), torch.from_numpy(wanted).to(device), config.loss)
        batches.learned(chosen, shares.cpu().numpy())
        optimiser.zero_grad()
        loss.backward()  # type: ignore[no-untyped-call]
        nn.utils.clip_grad_norm_(net.parameters(), settings.clip)
        optimiser.step()
        average.update_parameters(net)
        losses.append(float(loss.detach()))
        done = iteration + 1
        if done % 100 == 0 or done == settings.iterations:
            left = (time.monotonic() - started) / (done - first) * (settings.iterations - done)
            report(f"iteration {done} of {settings.iterations}, loss {np.mean(losses):.4f}, {left / 60:.1f} min left")
            _append(workspace.folder / LOSSES, done, float(np.mean(losses)), rate)
            losses.clear()
        if done % settings.checkpoint_every == 0 and done < settings.iterations:
            _save(workspace, done, net, average, optimiser, batches)
    trained: nn.Module = average.module
    return trained


def schedule(iteration: int, settings: Optimisation) -> float:
    """Factor of the learning rate: rises over the warm-up, then falls to 1 % along half a cosine."""
    if iteration < settings.warm_up:
        return (iteration + 1) / settings.warm_up
    through = (iteration - settings.warm_up) / max(1, settings.iterations - settings.warm_up)
    return float(0.01 + 0.99 * 0.5 * (1 + np.cos(np.pi * through)))


def _save(
    workspace: Workspace,
    done: int,
    net: nn.Module,
    average: nn.Module,
    optimiser: torch.optim.Optimizer,
    batches: Batches,
) -> None:
    state = {
        "done": done,
        "net": net.state_dict(),
        "average": average.state_dict(),
        "optimiser": optimiser.state_dict(),
        "difficulty": torch.from_numpy(batches.difficulty),
    }
    partial = workspace.folder / f"{CHECKPOINT}.part"
    torch.save(state, partial)
    os.replace(partial, workspace.folder / CHECKPOINT)


def _resume(
    workspace: Workspace, net: nn.Module, average: nn.Module, optimiser: torch.optim.Optimizer, batches: Batches
) -> int:
    path = workspace.folder / CHECKPOINT
    if not path.is_file():
        return 0
    state = torch.load(path, weights_only=True)
    net.load_state_dict(state["net"])
    average.load_state_dict(state["average"])
    optimiser.load_state_dict(state["optimiser"])
    batches.difficulty = state["difficulty"].numpy()
    return int(state["done"])


def _append(path: Path, iteration: int, loss: float, rate: float) -> None:
    new = not path.exists()
    with path.open("a", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        if new:
            writer.writerow(["iteration", "loss", "learning_rate"])
        writer.writerow([iteration, f"{loss:.6f}", f"{rate:.3g}"])
