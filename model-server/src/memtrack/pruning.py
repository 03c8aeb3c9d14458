# SPDX-License-Identifier: GPL-3.0-or-later
"""The False Positive Pruner: size, score and overlap filters over the pooled levels (paper section of that name)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool

from memtrack.boxes import non_maximum_suppression
from memtrack.detections import Detections, FilterCounts, Level
from memtrack.errors import SettingsError


@dataclass(frozen=True, slots=True)
class PrunerSettings:
    """What the pruner drops.

    thresholds: the lowest score kept, 0 to 1, one for each level, in the order of `Level`.
    max_size_px: a box wider or higher than this is dropped; 35 in the paper.
    nms_iou: of two boxes that overlap more, 0 to 1, the better scored one stays, whatever its level; 0.7 in the paper.

    Raises:
        SettingsError: a value is out of range.
    """

    thresholds: tuple[float, ...]
    max_size_px: float = 35.0
    nms_iou: float = 0.7

    def __post_init__(self) -> None:
        if len(self.thresholds) != len(Level) or not all(0 <= value <= 1 for value in self.thresholds):
            raise SettingsError(
                f"thresholds are {', '.join(map(str, self.thresholds))}; give {len(Level)} numbers from 0 to 1, "
                "for low, medium and high motility"
            )
        if not 0 < self.max_size_px < math.inf:
            raise SettingsError(f"max_size_px is {self.max_size_px}: give a size in pixels above 0")
        if not 0 <= self.nms_iou <= 1:
            raise SettingsError(f"nms_iou is {self.nms_iou}: give an overlap between 0 and 1")


def prune(
    candidates: Detections, settings: PrunerSettings, region: Bool[np.ndarray, "height width"] | None = None
) -> tuple[Detections, FilterCounts]:
    """Drops boxes in the paper's order: too wide or high, scored too low, overlapping a better one, outside the region.

    Args:
        candidates: boxes of all levels in the coordinates of the film.
        settings: what is dropped.
        region: where detections are wanted; a box counts as inside when its centre is.

    Returns:
        The detections kept, best first, and how many each filter dropped.
    """
    sized = candidates.select(_fits(candidates, settings))
    confident = sized.select(_passes(sized, settings))
    distinct = confident.select(non_maximum_suppression(confident.boxes, confident.scores, settings.nms_iou))
    kept = distinct if region is None else distinct.select(_inside(distinct, region))
    return kept, FilterCounts(
        candidates=len(candidates),
        too_large=len(candidates) - len(sized),
        near_misses=len(sized) - len(confident),
        overlapping=len(confident) - len(distinct),
        outside_region=len(distinct) - len(kept),
        kept=len(kept),
    )


def faint(
    candidates: Detections,
    kept: Detections,
    settings: PrunerSettings,
    region: Bool[np.ndarray, "height width"] | None = None,
) -> Detections:
    """The boxes that only the score threshold drops: they overlap neither a `kept` one nor a better one of their own.

    In one frame most are no bacteria; one that is found again and again along a track is.
    """
    near = candidates.select(_fits(candidates, settings) & ~_passes(candidates, settings))
    if region is not None:
        near = near.select(_inside(near, region))
    # Most are of one bacterium and were led to one place; telling these first keeps the overlaps few.
    near = near.select(np.argsort(-near.scores, kind="stable"))
    near = near.select(np.sort(np.unique(near.boxes, axis=0, return_index=True)[1]))
    boxes = np.concatenate([kept.boxes, near.boxes])
    stay = non_maximum_suppression(boxes, np.concatenate([kept.scores + 1, near.scores]), settings.nms_iou)
    return near.select(stay[stay >= len(kept)] - len(kept))


def _fits(detections: Detections, settings: PrunerSettings) -> Bool[np.ndarray, " n"]:
    size = detections.boxes[:, 2:] - detections.boxes[:, :2]
    fits: np.ndarray = size.max(axis=1, initial=0) <= settings.max_size_px
    return fits


def _passes(detections: Detections, settings: PrunerSettings) -> Bool[np.ndarray, " n"]:
    passes: np.ndarray = detections.scores >= np.asarray(settings.thresholds, np.float32)[detections.levels]
    return passes


def _inside(detections: Detections, region: Bool[np.ndarray, "height width"]) -> Bool[np.ndarray, " n"]:
    centres = np.rint(detections.centres).astype(np.int64)
    columns = np.clip(centres[:, 0], 0, region.shape[1] - 1)
    rows = np.clip(centres[:, 1], 0, region.shape[0] - 1)
    inside: np.ndarray = region[rows, columns]
    return inside
