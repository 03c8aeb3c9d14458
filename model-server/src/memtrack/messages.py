# SPDX-License-Identifier: GPL-3.0-or-later
"""Our values as messages of the contract."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from memtrack.detections import Detections, FilterCounts, FrameDetections, Level
from memtrack.headers import FilmRequest
from memtrack.libraries import library_versions
from memtrack.models import Model, ModelCard
from memtrack.pipeline import caveats
from memtrack.progress import Stage, Standing
from memtrack.scale import model_scale
from memtrack.settings import DetectionSettings
from memtrack.spool import SpooledFilm
from memtrack.v1 import detection_pb2 as pb
from memtrack.v1 import server_pb2

LEVELS = {Level.LOW: pb.LEVEL_LOW, Level.MEDIUM: pb.LEVEL_MEDIUM, Level.HIGH: pb.LEVEL_HIGH}


def accepted(request: FilmRequest, model: Model, film: SpooledFilm) -> pb.DetectFilmResponse:
    """What will be done with the film."""
    settings, card = request.settings, model.card
    return pb.DetectFilmResponse(
        accepted=pb.Accepted(
            model_name=card.name,
            model_version=card.version,
            model_sha256=model.digest,
            thresholds=thresholds(settings.pruner(card).thresholds),
            scale=model_scale(film, model, settings),
            engine=engine_name(model, settings),
            warnings=caveats(film, model, settings),
        )
    )


def engine_name(model: Model, settings: DetectionSettings) -> str:
    """The engine the settings come to, with its version."""
    kind = model.engine_kind(settings.engine)
    return f"{kind} {library_versions().get(kind, '(not installed)')} CPU"


def progress(standing: Standing, films_ahead: int = 0) -> pb.DetectFilmResponse:
    """Where the work stands."""
    return pb.DetectFilmResponse(
        progress=pb.Progress(
            stage=f"STAGE_{standing.stage.name}",
            frames_done=standing.frames_done,
            frames_total=standing.frames_total,
            fraction=standing.fraction,
            seconds_left=standing.seconds_left,
            films_ahead=films_ahead,
        )
    )


def frame(found: FrameDetections) -> pb.DetectFilmResponse:
    """What was found in one frame."""
    return pb.DetectFilmResponse(
        frame=pb.FrameDetections(
            frame=found.frame,
            detections=_boxes(found.detections),
            drift_x=found.drift_x,
            drift_y=found.drift_y,
            faint=_boxes(found.faint),
        )
    )


def _boxes(detections: Detections) -> list[pb.Detection]:
    rows = zip(
        detections.boxes.tolist(),
        detections.scores.tolist(),
        (LEVELS[Level(level)] for level in detections.levels.tolist()),
        _told(detections.contrasts, len(detections)),
        _told(detections.errors, len(detections)),
        strict=True,
    )
    return [
        pb.Detection(x_min=x0, y_min=y0, x_max=x1, y_max=y1, score=score, level=level, contrast=contrast, error=error)
        for (x0, y0, x1, y1), score, level, contrast, error in rows
    ]


def _told(column: np.ndarray | None, count: int) -> list[float | None]:
    """A column that may be missing."""
    return [None] * count if column is None else column.tolist()


def summary(
    request: FilmRequest,
    model: Model,
    counts: FilterCounts,
    film_sha256: str,
    seconds: Mapping[Stage, float],
    warnings: Sequence[str],
) -> pb.DetectFilmResponse:
    """What was kept and dropped over the whole film."""
    return pb.DetectFilmResponse(
        summary=pb.Summary(
            frame_count=request.geometry.frame_count,
            candidates=counts.candidates,
            too_large=counts.too_large,
            near_misses=counts.near_misses,
            overlapping=counts.overlapping,
            outside_region=counts.outside_region,
            kept=counts.kept,
            candidate_floor=model.card.decoder.floor,
            film_sha256=film_sha256,
            stage_times=[
                pb.StageTime(stage=f"STAGE_{stage.name}", seconds=spent) for stage, spent in sorted(seconds.items())
            ],
            warnings=warnings,
        )
    )


def card(model: ModelCard, digest: str) -> server_pb2.ModelCard:
    """A model of the registry."""
    shortest, longest = model.cell_length_px
    return server_pb2.ModelCard(
        name=model.name,
        version=model.version,
        description=model.description,
        feature_spec=f"{model.features.name} {model.features.version}",
        architecture=str(model.architecture.get("name", "")),
        box_size_px=model.decoder.box_size_px,
        min_cell_length_px=shortest,
        max_cell_length_px=longest,
        max_precision=thresholds(model.thresholds["max_precision"]),
        max_f1=thresholds(model.thresholds["max_f1"]),
        sha256=digest,
        licence=model.licence,
        json=model.to_json(),
    )


def thresholds(values: Sequence[float]) -> pb.LevelThresholds:
    """Lowest scores of the low, medium and high level."""
    low, medium, high = values
    return pb.LevelThresholds(low=low, medium=medium, high=high)
