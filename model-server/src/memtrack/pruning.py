# SPDX-License-Identifier: GPL-3.0-or-later
"""The False Positive Pruner: size, score and overlap filters over the pooled levels (paper section of that name)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool

from memtrack.boxes import non_maximum_suppression
from memtrack.detections import Detections, FilterCounts


def prune(
    candidates: Detections,
    *,
    thresholds: Sequence[float],
    max_size_px: float,
    nms_iou: float,
    region: Bool[np.ndarray, "height width"] | None = None,
) -> tuple[Detections, FilterCounts]:
    """Drops boxes in the paper's order: too wide or high, scored too low, overlapping a better one, outside the region.

    Args:
        candidates: boxes of all levels in the coordinates of the film.
        thresholds: the lowest score kept, one for each level, in the order of `Level`.
        max_size_px: a box wider or higher than this is dropped (35 in the paper).
        nms_iou: of two boxes that overlap more, the better scored one stays, whatever its level (0.7 in the paper).
        region: where detections are wanted; a box counts as inside when its centre is.

    Returns:
        The detections kept, best first, and how many each filter dropped.
    """
    sized = candidates.select(_fits(candidates, max_size_px))
    confident = sized.select(_passes(sized, thresholds))
    distinct = confident.select(non_maximum_suppression(confident.boxes, confident.scores, nms_iou))
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
    *,
    thresholds: Sequence[float],
    max_size_px: float,
    nms_iou: float,
    region: Bool[np.ndarray, "height width"] | None = None,
) -> Detections:
    """The boxes that only the score threshold drops: they overlap neither a `kept` one nor a better one of their own.

    In one frame most are no bacteria; one that is found again and again along a track is.
    """
    near = candidates.select(_fits(candidates, max_size_px) & ~_passes(candidates, thresholds))
    if region is not None:
        near = near.select(_inside(near, region))
    # Most are of one bacterium and were led to one place; telling these first keeps the overlaps few.
    near = near.select(np.argsort(-near.scores, kind="stable"))
    near = near.select(np.sort(np.unique(near.boxes, axis=0, return_index=True)[1]))
    boxes = np.concatenate([kept.boxes, near.boxes])
    stay = non_maximum_suppression(boxes, np.concatenate([kept.scores + 1, near.scores]), nms_iou)
    return near.select(stay[stay >= len(kept)] - len(kept))


def _fits(detections: Detections, max_size_px: float) -> Bool[np.ndarray, " n"]:
    size = detections.boxes[:, 2:] - detections.boxes[:, :2]
    fits: np.ndarray = size.max(axis=1, initial=0) <= max_size_px
    return fits


def _passes(detections: Detections, thresholds: Sequence[float]) -> Bool[np.ndarray, " n"]:
    passes: np.ndarray = detections.scores >= np.asarray(thresholds, np.float32)[detections.levels]
    return passes


def _inside(detections: Detections, region: Bool[np.ndarray, "height width"]) -> Bool[np.ndarray, " n"]:
    centres = np.rint((detections.boxes[:, :2] + detections.boxes[:, 2:]) / 2).astype(np.int64)
    columns = np.clip(centres[:, 0], 0, region.shape[1] - 1)
    rows = np.clip(centres[:, 1], 0, region.shape[0] - 1)
    inside: np.ndarray = region[rows, columns]
    return inside
