# SPDX-License-Identifier: GPL-3.0-or-later
"""The optimisation of a net on samples, which can be interrupted and goes on from its checkpoint. Needs torch."""

from __future__ import annotations

import csv
import dataclasses
import hashlib
import json
import math
import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import nn

from memtrack.errors import ModelNotFoundError, SettingsError
from memtrack.models import Model, load_model
from memtrack.motion import SPECS
from memtrack.retinanet import STRIDE, Net, build
from memtrack.training.batches import Batches
from memtrack.training.config import ModelSettings, Optimisation, Refinement, TrainingConfig
from memtrack.training.figures import LOSSES
from memtrack.training.loss import detection_loss
from memtrack.training.samples import FilmSamples

Report = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Workspace:
    """Folder of one training, which can be interrupted and resumed: samples, checkpoint, loss curve, figures."""

    folder: Path

    @property
    def samples(self) -> Path:
        """Where samples of simulated films are kept."""
        return self.folder / "samples"

    @property
    def checkpoint(self) -> Path:
        """Where an unfinished training stands."""
        return self.folder / "checkpoint.pt"


def architecture(model: ModelSettings) -> dict[str, object]:
    """The `architecture` entry of the model's card."""
    if model.architecture != "compact":
        return {"name": model.architecture}
    return {"name": "compact", "widths": list(model.widths), "depths": list(model.depths)}


def new_net(model: ModelSettings) -> Net:
    """The net to train: fresh, or with the weights of the model to start from.

    Raises:
        ModelNotFoundError: that model is missing, or has other features or another net.
    """
    channels = len(SPECS[model.features].channels)
    net = build(architecture(model), channels)
    if model.start_from:
        import safetensors.torch

        net.load_state_dict(safetensors.torch.load_file(start_model(model).weights), strict=False)
    return net


def start_model(model: ModelSettings) -> Model:
    """The model to start from.

    Raises:
        ModelNotFoundError: it is missing, or has other features or another net.
    """
    start = _named(model.start_from)
    if start.card.features != SPECS[model.features] or start.card.architecture != architecture(model):
        raise ModelNotFoundError(
            f"model {model.start_from} has other features or another net than this training: start from one like it"
        )
    return start


def crowds_model(model: ModelSettings) -> str:
    """The `crowds` entry of the model's card, with the version that is the newest now where none is given.

    Raises:
        ModelNotFoundError: that model is missing, or has other features or cells.
    """
    if not model.crowds:
        return ""
    card = _named(model.crowds).card
    if card.features != SPECS[model.features] or card.cell_length_px != model.cell_length_px:
        raise ModelNotFoundError(
            f"model {model.crowds} has other features or cells of another length than this training: name one like it "
            "in crowds"
        )
    return f"{card.name} {card.version}"


def _named(words: str) -> Model:
    """The model of a recipe's 'name' or 'name version'."""
    name, _, version = words.partition(" ")
    return load_model(name, version or None)


def optimise(
    config: TrainingConfig, films: list[FilmSamples], workspace: Workspace, device: str, report: Report
) -> nn.Module:
    """Trains the net; goes on from the workspace's checkpoint if there is one. Returns the averaged net.

    Raises:
        SettingsError: the checkpoint is of another recipe, or the loss is no number any more.
    """
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
    first = _resume(read_checkpoint(config, workspace), net, average, optimiser, batches)
    _forget_losses(workspace.folder / LOSSES, first)
    kind = device.split(":")[0]
    short = settings.bfloat16 and computes_bfloat16(kind)
    losses: list[float] = []
    started = time.monotonic()
    for iteration in range(first, settings.iterations):
        rate = settings.learning_rate * schedule(iteration, settings)
        for group in optimiser.param_groups:
            group["lr"] = rate
        # Seeded by its number, so that a resumed training draws what an uninterrupted one would have drawn.
        features, wanted, chosen = batches.draw(np.random.default_rng([settings.seed, iteration]))
        inputs = torch.from_numpy(features).to(device, memory_format=torch.channels_last)
        with torch.autocast(kind, dtype=torch.bfloat16, enabled=short):
            maps = net(inputs)
        loss, shares = detection_loss(maps.float(), torch.from_numpy(wanted).to(device), config.loss)
        batches.learned(chosen, shares.cpu().numpy())
        losses.append(learn(loss, net, average, optimiser, settings, iteration))
        done = iteration + 1
        if done % 100 == 0 or done == settings.iterations:
            left = (time.monotonic() - started) / (done - first) * (settings.iterations - done)
            report(f"iteration {done} of {settings.iterations}, loss {np.mean(losses):.4f}, {left / 60:.1f} min left")
            _append(workspace.folder / LOSSES, done, float(np.mean(losses)), rate)
            losses.clear()
        if done % settings.checkpoint_every == 0 and done < settings.iterations:
            _save(workspace, config, done, net, average, optimiser, batches)
    trained: nn.Module = average.module
    return trained


def learn(
    loss: torch.Tensor,
    net: nn.Module,
    average: torch.optim.swa_utils.AveragedModel,
    optimiser: torch.optim.Optimizer,
    settings: Optimisation | Refinement,
    iteration: int,
) -> float:
    """One step of `net` and its running mean down the slope of `loss`, whose value it returns.

    Raises:
        SettingsError: the value, after `iteration` steps, is not finite.
    """
    value = float(loss.detach())
    if not math.isfinite(value):
        part = type(settings).__name__.lower()
        raise SettingsError(f"the loss is no number after iteration {iteration}: lower learning_rate in [{part}]")
    optimiser.zero_grad()
    loss.backward()  # type: ignore[no-untyped-call]
    nn.utils.clip_grad_norm_(net.parameters(), settings.clip)
    optimiser.step()
    average.update_parameters(net)
    return value


def computes_bfloat16(kind: str) -> bool:
    """Whether this machine is quicker with bfloat16; without AVX-512 it takes a processor ten times as long."""
    if kind == "cpu":
        return torch.backends.cpu.get_cpu_capability() == "AVX512"
    return kind == "cuda" and torch.cuda.is_bf16_supported()


def schedule(iteration: int, settings: Optimisation | Refinement) -> float:
    """Factor of the learning rate: rises over the warm-up, then falls to 1 % along half a cosine."""
    if iteration < settings.warm_up:
        return (iteration + 1) / settings.warm_up
    through = (iteration - settings.warm_up) / max(1, settings.iterations - settings.warm_up)
    return float(0.01 + 0.99 * 0.5 * (1 + np.cos(np.pi * through)))


def read_checkpoint(config: TrainingConfig, workspace: Workspace) -> dict[str, Any] | None:
    """Where an interrupted training by this recipe stands; None where there was none.

    Raises:
        SettingsError: the workspace is another training's.
    """
    if not workspace.checkpoint.is_file():
        return None
    state: dict[str, Any] = torch.load(workspace.checkpoint, map_location="cpu", weights_only=True)
    if state.get("recipe") != _digest(config):
        raise SettingsError(
            f"{workspace.checkpoint} is of a training by another recipe; delete it, or give another --workspace"
        )
    return state


def _digest(config: TrainingConfig) -> str:
    """SHA-256 of the whole recipe, which states also how many films there are."""
    return hashlib.sha256(json.dumps(dataclasses.asdict(config)).encode()).hexdigest()


def _save(
    workspace: Workspace,
    config: TrainingConfig,
    done: int,
    net: nn.Module,
    average: nn.Module,
    optimiser: torch.optim.Optimizer,
    batches: Batches,
) -> None:
    state = {
        "recipe": _digest(config),
        "done": done,
        "net": net.state_dict(),
        "average": average.state_dict(),
        "optimiser": optimiser.state_dict(),
        "difficulty": torch.from_numpy(batches.difficulty),
    }
    partial = workspace.checkpoint.with_suffix(".part")
    torch.save(state, partial)
    os.replace(partial, workspace.checkpoint)


def _resume(
    state: dict[str, Any] | None,
    net: nn.Module,
    average: nn.Module,
    optimiser: torch.optim.Optimizer,
    batches: Batches,
) -> int:
    if state is None:
        return 0
    net.load_state_dict(state["net"])
    average.load_state_dict(state["average"])
    optimiser.load_state_dict(state["optimiser"])
    batches.difficulty = state["difficulty"].numpy()
    return int(state["done"])


def _forget_losses(path: Path, done: int) -> None:
    """Drops the rows after iteration `done`, which are made anew."""
    lines = path.read_bytes().splitlines(keepends=True) if path.is_file() else []
    kept = [line for line in lines[1:] if int(line.split(b",")[0]) <= done]
    if kept:
        path.write_bytes(b"".join(lines[:1] + kept))
    else:
        path.unlink(missing_ok=True)


def _append(path: Path, iteration: int, loss: float, rate: float) -> None:
    new = not path.exists()
    with path.open("a", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        if new:
            writer.writerow(["iteration", "loss", "learning_rate"])
        writer.writerow([iteration, f"{loss:.6f}", f"{rate:.3g}"])
