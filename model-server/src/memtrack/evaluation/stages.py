# SPDX-License-Identifier: GPL-3.0-or-later
"""The detector's candidates on their way through the pipeline, as in the paper's figure of precision and recall.

Each level, pooled, size, score, NMS; the tracker and the length filter follow in `memtrack.evaluation.evaluate`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from memtrack.detections import Detections, FrameDetections, Level
from memtrack.errors import SettingsError
from memtrack.pruning import prune
from memtrack.tracks import UNLINKED, TrackTable


@dataclass(frozen=True, slots=True)
class PrunerSettings:
    """Settings of the False Positive Pruner: a threshold a level, greatest edge of a box, greatest overlap."""

    thresholds: tuple[float, ...]
    max_size_px: float = 35.0
    nms_iou: float = 0.7

    def __post_init__(self) -> None:
        if len(self.thresholds) != len(Level) or not all(0 <= value <= 1 for value in self.thresholds):
            raise SettingsError(
                f"thresholds are {', '.join(map(str, self.thresholds))}; give {len(Level)} numbers from 0 to 1, "
                "for low, medium and high motility"
            )


def as_table(frames: Sequence[FrameDetections]) -> TrackTable:
    """Detections of a film as unlinked rows of a table."""
    found = [frame.detections for frame in frames] or [Detections.empty()]
    boxes = np.concatenate([detections.boxes for detections in found]).astype(np.float64)
    return TrackTable.of(
        np.repeat([frame.frame for frame in frames], [len(frame.detections) for frame in frames]),
        UNLINKED,
        (boxes[:, 0] + boxes[:, 2]) / 2,
        (boxes[:, 1] + boxes[:, 3]) / 2,
        width=boxes[:, 2] - boxes[:, 0],
        height=boxes[:, 3] - boxes[:, 1],
        scores=np.concatenate([detections.scores for detections in found]),
    )


def candidate_steps(frames: Sequence[FrameDetections]) -> Iterator[tuple[str, TrackTable]]:
    """The candidates of each level, then of all levels pooled, by the name of the step."""
    for name, of_level in _levels(frames):
        yield name, as_table(of_level)


def curve_sets(frames: Sequence[FrameDetections], max_size_px: float, nms_iou: float) -> dict[str, TrackTable]:
    """The same after the size filter and NMS, which a score threshold may as well follow: for precision and recall.

    A box is suppressed only by better scored ones, so a threshold leaves the same whether it comes before or after.
    """
    return {name: as_table(_pruned(of_level, _ALL, max_size_px, nms_iou)) for name, of_level in _levels(frames)}


def pruning_steps(frames: Sequence[FrameDetections], settings: PrunerSettings) -> Iterator[tuple[str, TrackTable]]:
    """What is left after each filter of the pruner, by the name of the step."""
    for name, thresholds, overlap in (
        ("size", _ALL, 1.0),
        ("score", settings.thresholds, 1.0),
        ("NMS", settings.thresholds, settings.nms_iou),
    ):
        yield name, as_table(_pruned(frames, thresholds, settings.max_size_px, overlap))


_ALL = (0.0,) * len(Level)


def _levels(frames: Sequence[FrameDetections]) -> Iterator[tuple[str, Sequence[FrameDetections]]]:
    for level in Level:
        of_level = [FrameDetections(f.frame, f.detections.select(f.detections.levels == level)) for f in frames]
        yield level.name.lower(), of_level
    yield "pooled", frames


def _pruned(
    frames: Sequence[FrameDetections], thresholds: tuple[float, ...], max_size_px: float, nms_iou: float
) -> list[FrameDetections]:
    return [
        FrameDetections(
            f.frame, prune(f.detections, thresholds=thresholds, max_size_px=max_size_px, nms_iou=nms_iou)[0]
        )
        for f in frames
    ]
