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
    for level in Level:
        of_level = [FrameDetections(f.frame, f.detections.select(f.detections.levels == level)) for f in frames]
        yield level.name.lower(), as_table(of_level)
    yield "pooled", as_table(frames)


def pruning_steps(frames: Sequence[FrameDetections], settings: PrunerSettings) -> Iterator[tuple[str, TrackTable]]:
    """What is left after each filter of the pruner, by the name of the step."""
    everything = (0.0,) * len(Level)
    for name, thresholds, overlap in (
        ("size", everything, 1.0),
        ("score", settings.thresholds, 1.0),
        ("NMS", settings.thresholds, settings.nms_iou),
    ):
        yield (
            name,
            as_table(
                [
                    FrameDetections(
                        f.frame,
                        prune(f.detections, thresholds=thresholds, max_size_px=settings.max_size_px, nms_iou=overlap)[
                            0
                        ],
                    )
                    for f in frames
                ]
            ),
        )
