# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole training: samples, detector, calibration, thresholds, refiner, registration. Needs torch."""

from __future__ import annotations

import dataclasses
import json
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from memtrack.channels import NEUTRAL
from memtrack.detections import Level
from memtrack.detector import Decoder, Engine
from memtrack.engines import OpenVinoEngine, OpenVinoRefiner
from memtrack.models import CENTRE_OPENVINO, CENTRE_WEIGHTS, OPENVINO, WEIGHTS, Model, ModelCard, register
from memtrack.motion import SPECS
from memtrack.refinement import EDGE_PX
from memtrack.retinanet import STRIDE
from memtrack.training import figures, thresholds
from memtrack.training.centres import centre_samples, optimise_centres
from memtrack.training.config import TrainingConfig
from memtrack.training.export import export
from memtrack.training.films import annotated_samples, check_annotated, simulated_samples
from memtrack.training.optimise import (
    Report,
    Workspace,
    architecture,
    crowds_model,
    new_net,
    optimise,
    read_checkpoint,
    start_model,
)
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
        InvalidInputError: an annotated film or its tracks cannot be read.
        SettingsError: the workspace holds the checkpoint of a training by another recipe, a film lacks its scale, or
            the loss is no number any more.
        ModelNotFoundError: the model to start from, or that for crowds, is missing or does not fit.
    """
    started = time.monotonic()
    workspace.folder.mkdir(parents=True, exist_ok=True)
    # What cannot be used is refused before the films are made.
    read_checkpoint(config, workspace)
    new_net(config.model)
    crowds = crowds_model(config.model)
    check_annotated(config.annotated, base)
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
    # Windows deletes no file that is mapped, as an engine has its weights: what is left is the system's to clear away.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        detector = _detector(config, training, validation, workspace, Path(temporary), device, report)
        centre_files = _centre_files(config, detector, training, Path(temporary), device, report)
        refiner = OpenVinoRefiner(centre_files[CENTRE_OPENVINO]) if centre_files else None
        scored = thresholds.score_films(validation, detector.engine, detector.decoder, refiner)
        results = summary(scored, validation, detector.engine, detector.decoder)
        report(json.dumps(results))
        if not scored.found.any():
            report(
                "nothing that the model finds in the validation films is right: check that their tracks lie on the "
                "bacteria, or train for longer"
            )
        minutes = (time.monotonic() - started) / 60
        card = ModelCard(
            name=config.model.name,
            version="0",
            description=config.model.description,
            licence=config.model.licence,
            architecture=architecture(config.model),
            features=spec,
            decoder=detector.decoder,
            levels=tuple(level.name.lower() for level in Level),
            cell_length_px=config.model.cell_length_px,
            thresholds=detector.thresholds,
            refiner={"widths": list(config.refinement.widths)} if refiner else {},
            crowds=crowds,
            training={"config": dataclasses.asdict(config), "minutes": round(minutes, 1)},
            results=results,
        )
        model = register(card, detector.files | centre_files, root)
    workspace.checkpoint.unlink(missing_ok=True)
    return model


@dataclass(frozen=True, slots=True)
class _Detector:
    """A trained net, ready to run, with what its card says of it and its files of the registry."""

    engine: Engine
    decoder: Decoder
    thresholds: dict[str, tuple[float, ...]]
    files: dict[str, Path]


def _detector(
    config: TrainingConfig,
    training: list[FilmSamples],
    validation: list[FilmSamples],
    workspace: Workspace,
    folder: Path,
    device: str,
    report: Report,
) -> _Detector:
    """Trains, exports into `folder`, calibrates and chooses thresholds; or takes the model to start from as it is."""
    if not config.optimisation.iterations:
        start = start_model(config.model)
        centres = [Path(name).stem for name in (CENTRE_WEIGHTS, CENTRE_OPENVINO)]
        kept = {name: start.folder / name for name in start.card.files if Path(name).stem not in centres}
        return _Detector(start.engine(), start.card.decoder, start.card.thresholds, kept)
    net = optimise(config, training, workspace, device, report)
    typical = [frame[None] for frame in typical_frames(training)]
    files = export(net, typical, folder / WEIGHTS, folder / OPENVINO, quantise=True)
    engine = OpenVinoEngine(folder / OPENVINO)
    raw = Decoder(stride=STRIDE, box_size_px=config.model.box_size_px, floor=0.1)
    first = thresholds.score_films(validation, engine, raw)
    slope, offset = thresholds.calibration(first.scores, first.found)
    decoder = dataclasses.replace(raw, slope=slope, offset=offset, floor=0.05)
    scored = thresholds.score_films(validation, engine, decoder)
    curves = {level.name.lower(): thresholds.curve(scored, level) for level in Level}
    chosen = thresholds.choose(scored)
    figures.write(workspace.folder, curves, chosen)
    rounded = {criterion: tuple(round(t, 4) for t in values) for criterion, values in chosen.items()}
    return _Detector(engine, decoder, rounded, files)


def _centre_files(
    config: TrainingConfig,
    detector: _Detector,
    training: list[FilmSamples],
    folder: Path,
    device: str,
    report: Report,
) -> dict[str, Path]:
    """Trains the net that refines the detector's centres and exports it into `folder`; its files, or none."""
    if not config.refinement.iterations:
        return {}
    report(f"finding the bacteria of {len(training)} films, whose centres are learnt then")
    samples = centre_samples(training, detector.engine, detector.decoder)
    if not len(samples.crops):
        report("no bacterium of the training films was found: centres are not refined")
        return {}
    start = start_model(config.model) if config.model.start_from else None
    alike = start is not None and start.card.refiner.get("widths") == list(config.refinement.widths)
    weights = start.folder / CENTRE_WEIGHTS if start is not None and alike else None
    net = optimise_centres(config.refinement, samples, SPECS[config.model.features], device, report, weights)
    crop = np.full((1, *samples.crops.shape[1:2], EDGE_PX, EDGE_PX), NEUTRAL, np.uint8)
    return export(net, [crop], folder / CENTRE_WEIGHTS, folder / CENTRE_OPENVINO, quantise=False)


def typical_frames(films: list[FilmSamples]) -> list[np.ndarray]:
    """Features of one frame each of films spread over the list, for the ranges of the 8-bit net."""
    chosen = np.linspace(0, len(films) - 1, min(CALIBRATION_FRAMES, len(films))).astype(int)
    return [np.ascontiguousarray(films[i].features[len(films[i]) // 2]) for i in chosen]


def summary(scored: thresholds.Scored, films: list[FilmSamples], engine: Engine, decoder: Decoder) -> dict[str, object]:
    """Figures of the card: best F1 over all and by family, at one threshold, and the error of the centres."""
    whole = thresholds.curve(scored)
    if not len(whole.thresholds):
        return {"frames": scored.frames, "f1": 0.0}
    best = int(whole.f1.argmax())
    threshold = float(whole.thresholds[best])
    error = scored.error[scored.found & (scored.scores >= threshold)]
    out: dict[str, object] = {
        "frames": scored.frames,
        "threshold": round(threshold, 3),
        "precision": round(float(whole.precision[best]), 4),
        "recall": round(float(whole.recall[best]), 4),
        "f1": round(float(whole.f1[best]), 4),
        "centre_rms_px": round(float(np.sqrt(np.mean(np.square(error)))), 3) if len(error) else None,
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
