# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole training: make the films' samples, optimise, calibrate, choose thresholds, register. Needs torch."""

from __future__ import annotations

import dataclasses
import json
import tempfile
import time
from pathlib import Path

import numpy as np
from torch import nn

from memtrack.detections import Level
from memtrack.detector import Decoder
from memtrack.engines import OpenVinoEngine
from memtrack.models import OPENVINO, Model, ModelCard, register
from memtrack.motion import SPECS
from memtrack.retinanet import STRIDE
from memtrack.training import figures, thresholds
from memtrack.training.config import TrainingConfig
from memtrack.training.export import export
from memtrack.training.films import annotated_samples, simulated_samples
from memtrack.training.optimise import Report, Workspace, architecture, new_net, optimise, read_checkpoint
from memtrack.training.samples import FilmSamples

CALIBRATION_FRAMES = 64


def train(
    config: TrainingConfig,
    workspace: Workspace,
    root: Path | None,
    *,
    base: Path,
    device: str,
    workers: int,
    report: Report,
) -> Model:
    """Runs `config` to the end and registers the model as a new version under `root` (the user's models by default).

    `base` is the folder to which the paths of annotated films are relative. The workspace keeps samples, checkpoint,
    loss curve and precision-recall curves; the checkpoint of a finished training is deleted.

    Raises:
        SettingsError: the workspace holds the checkpoint of a training by another recipe.
        ModelNotFoundError: the model to start from is missing, or has another net.
    """
    started = time.monotonic()
    workspace.folder.mkdir(parents=True, exist_ok=True)
    # What cannot be used is refused before the films are made.
    read_checkpoint(config, workspace)
    new_net(config.model)
    spec = SPECS[config.model.features]

    def films(done: int, total: int) -> None:
        if done % 10 == 0 or done == total:
            report(f"film {done} of {total}")

    parts = []
    for role, sets in (("training", config.training), ("validation", config.validation)):
        own = [a for a in config.annotated if a.role == role]
        parts.append(
            simulated_samples(sets, spec, workspace.samples, workers=workers, report=films)
            + annotated_samples(own, spec, config.model.cell_length_px, base, seed=config.optimisation.seed)
        )
    training, validation = parts
    net = optimise(config, training, workspace, device, report)
    minutes = (time.monotonic() - started) / 60
    model = finish(config, net, training, validation, workspace, root, minutes=minutes, report=report)
    workspace.checkpoint.unlink(missing_ok=True)
    return model


def finish(
    config: TrainingConfig,
    net: nn.Module,
    training: list[FilmSamples],
    validation: list[FilmSamples],
    workspace: Workspace,
    root: Path | None,
    *,
    minutes: float,
    report: Report,
) -> Model:
    """Exports, calibrates, chooses thresholds and registers a trained net."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        files = export(net, typical_frames(training), folder)
        engine = OpenVinoEngine(folder / OPENVINO)
        raw = Decoder(stride=STRIDE, box_size_px=config.model.box_size_px, floor=0.1)
        first = thresholds.score_films(validation, engine, raw)
        slope, offset = thresholds.calibration(first.scores, first.found)
        decoder = dataclasses.replace(raw, slope=slope, offset=offset, floor=0.05)
        scored = thresholds.score_films(validation, engine, decoder)
        curves = {level.name.lower(): thresholds.curve(scored, level) for level in Level}
        chosen = thresholds.choose(scored)
        figures.write(workspace.folder, curves, chosen)
        results = summary(scored, validation, engine, decoder)
        report(json.dumps(results))
        card = ModelCard(
            name=config.model.name,
            version="0",
            description=config.model.description,
            licence=config.model.licence,
            architecture=architecture(config.model),
            features=SPECS[config.model.features],
            decoder=decoder,
            levels=tuple(level.name.lower() for level in Level),
            cell_length_px=config.model.cell_length_px,
            thresholds={criterion: tuple(round(t, 4) for t in values) for criterion, values in chosen.items()},
            training={"config": dataclasses.asdict(config), "minutes": round(minutes, 1)},
            results=results,
        )
        return register(card, files, root)


def typical_frames(films: list[FilmSamples]) -> list[np.ndarray]:
    """Features of one frame each of films spread over the list, for the ranges of the 8-bit net."""
    chosen = np.linspace(0, len(films) - 1, min(CALIBRATION_FRAMES, len(films))).astype(int)
    return [np.ascontiguousarray(films[i].features[len(films[i]) // 2]) for i in chosen]


def summary(
    scored: thresholds.Scored, films: list[FilmSamples], engine: OpenVinoEngine, decoder: Decoder
) -> dict[str, object]:
    """Figures of the card: best F1 over all and by family, at one threshold, and the error of the centres."""
    whole = thresholds.curve(scored)
    if not len(whole.thresholds):
        return {"frames": scored.frames, "f1": 0.0}
    best = int(whole.f1.argmax())
    threshold = float(whole.thresholds[best])
    right = scored.found & (scored.scores >= threshold)
    out: dict[str, object] = {
        "frames": scored.frames,
        "threshold": round(threshold, 3),
        "precision": round(float(whole.precision[best]), 4),
        "recall": round(float(whole.recall[best]), 4),
        "f1": round(float(whole.f1[best]), 4),
        "centre_rms_px": round(float(np.sqrt(np.mean(np.square(scored.error[right])))), 3),
    }
    for family in sorted({film.family for film in films}):
        part = thresholds.score_films([f for f in films if f.family == family], engine, decoder)
        above = part.scores >= threshold
        hits, total = int((part.found & above).sum()), int(part.truths.sum())
        wrong = int((~part.found & above).sum())
        out[family] = {
            "bacteria": total,
            "precision": round(hits / max(hits + wrong, 1), 4),
            "recall": round(hits / total, 4) if total else None,
            "false_per_frame": round(wrong / part.frames, 3),
        }
    return out
