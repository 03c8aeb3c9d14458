# SPDX-License-Identifier: GPL-3.0-or-later
"""The detector's candidates on their way through the pipeline, as in the paper's figure of precision and recall.

Each level, pooled, size, score, NMS; the tracker and the length filter follow in `memtrack.evaluation.evaluate`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from memtrack.detections import Detections, FrameDetections, Level
from memtrack.pruning import PrunerSettings, prune
from memtrack.tracks import UNLINKED, TrackTable


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
    filters = PrunerSettings(_ALL, max_size_px, nms_iou)
    return {name: as_table(_pruned(of_level, filters)) for name, of_level in _levels(frames)}


def pruning_steps(frames: Sequence[FrameDetections], settings: PrunerSettings) -> Iterator[tuple[str, TrackTable]]:
    """What is left after each filter of the pruner, by the name of the step."""
    steps = {
        "size": replace(settings, thresholds=_ALL, nms_iou=1.0),
        "score": replace(settings, nms_iou=1.0),
        "NMS": settings,
    }
    for name, filters in steps.items():
        yield name, as_table(_pruned(frames, filters))


_ALL = (0.0,) * len(Level)


def _levels(frames: Sequence[FrameDetections]) -> Iterator[tuple[str, Sequence[FrameDetections]]]:
    for level in Level:
        of_level = [FrameDetections(f.frame, f.detections.select(f.detections.levels == level)) for f in frames]
        yield level.name.lower(), of_level
    yield "pooled", frames


def _pruned(frames: Sequence[FrameDetections], filters: PrunerSettings) -> list[FrameDetections]:
    return [FrameDetections(f.frame, prune(f.detections, filters)[0]) for f in frames]
