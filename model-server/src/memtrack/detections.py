# SPDX-License-Identifier: GPL-3.0-or-later
"""Values passed from the detector to its callers: detections of one frame and what each filter dropped.

Boxes are `x_min y_min x_max y_max` in pixels of the film as the user sees it; the centre of pixel (0, 0) has the
coordinates (0, 0). Frames are numbered from 0.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float32, Int8


class Level(enum.IntEnum):
    """Motility level of the detector that found a box (paper section "Multi-level Object Detector")."""

    LOW = 0
    MEDIUM = 1
    HIGH = 2


@dataclass(frozen=True, slots=True)
class Detections:
    """Boxes with their scores, levels, contrasts (`memtrack.contrast`) and errors; row i of each array tells of box i.

    contrasts: None where they were not measured. errors: how far off each centre is to be expected along x or y, root
    mean square, in pixels (`memtrack.refinement`); None where the model does not tell.
    """

    boxes: Float32[np.ndarray, "n 4"]
    scores: Float32[np.ndarray, " n"]
    levels: Int8[np.ndarray, " n"]
    contrasts: Float32[np.ndarray, " n"] | None = None
    errors: Float32[np.ndarray, " n"] | None = None

    def __post_init__(self) -> None:
        n = len(self.boxes)
        if self.boxes.shape != (n, 4) or self.scores.shape != (n,) or self.levels.shape != (n,):
            raise ValueError(
                f"boxes {self.boxes.shape}, scores {self.scores.shape} and levels {self.levels.shape} do not fit"
            )
        for name in ("contrasts", "errors"):
            told = getattr(self, name)
            if told is not None and told.shape != (n,):
                raise ValueError(f"{n} boxes and {name} {told.shape} do not fit")

    def __len__(self) -> int:
        return len(self.boxes)

    @property
    def centres(self) -> Float32[np.ndarray, "n 2"]:
        """Middle of each box, (x, y)."""
        return (self.boxes[:, :2] + self.boxes[:, 2:]) / 2

    def select(self, rows: np.ndarray) -> Detections:
        """The detections at `rows`, a boolean mask or an array of indices, in that order."""
        contrasts = None if self.contrasts is None else self.contrasts[rows]
        errors = None if self.errors is None else self.errors[rows]
        return Detections(self.boxes[rows], self.scores[rows], self.levels[rows], contrasts, errors)

    @staticmethod
    def empty() -> Detections:
        """No detection."""
        return Detections(np.zeros((0, 4), np.float32), np.zeros(0, np.float32), np.zeros(0, np.int8))


@dataclass(frozen=True, slots=True)
class FilterCounts:
    """How many candidate boxes of one frame each step of the False Positive Pruner dropped, in the order of the steps.

    `candidates` are the boxes above the detector's own floor, `near_misses` those of them that the score threshold
    dropped; candidates = too_large + near_misses + overlapping + outside_region + kept.
    """

    candidates: int = 0
    too_large: int = 0
    near_misses: int = 0
    overlapping: int = 0
    outside_region: int = 0
    kept: int = 0

    def __add__(self, other: FilterCounts) -> FilterCounts:
        return FilterCounts(
            self.candidates + other.candidates,
            self.too_large + other.too_large,
            self.near_misses + other.near_misses,
            self.overlapping + other.overlapping,
            self.outside_region + other.outside_region,
            self.kept + other.kept,
        )


@dataclass(frozen=True, slots=True)
class FrameDetections:
    """What was found in one frame.

    `drift_x`, `drift_y`: how far the scene stands from its place in frame 0, in pixels, as the stabilisation
    measured it (0 when it is off); boxes are not corrected by it. `faint`: boxes that only their score keeps from being
    detections, see `memtrack.pruning.faint`.
    """

    frame: int
    detections: Detections
    counts: FilterCounts = field(default_factory=FilterCounts)
    drift_x: float = 0.0
    drift_y: float = 0.0
    faint: Detections = field(default_factory=Detections.empty)
