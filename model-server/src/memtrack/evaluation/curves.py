# SPDX-License-Identifier: GPL-3.0-or-later
"""Precision and recall of detections against the score they must have."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from memtrack.evaluation.matching import Counts, Criterion, FramePair, pair_frames, settle
from memtrack.tracks import TrackTable

POINTS = 40


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """Counts over all films when only detections with at least this score are kept."""

    threshold: float
    counts: Counts


def precision_recall_curve(
    films: Sequence[tuple[TrackTable, TrackTable]], criterion: Criterion, points: int = POINTS
) -> list[CurvePoint]:
    """The curve of pairs of truth and scored detections, summed over films, from low to high scores.

    Half of the thresholds are spread evenly over the scores' ranks, half over their range. Each point is matched anew,
    so it is exactly what the paper's measure gives for that threshold.
    """
    scores = np.sort(np.concatenate([detections.scores for _, detections in films] or [np.zeros(0)]))
    if not len(scores) or np.isnan(scores).any():
        return []
    by_rank = scores[np.linspace(0, len(scores) - 1, points // 2).astype(int)]
    thresholds = np.unique(np.concatenate([by_rank, np.linspace(scores[0], scores[-1], points - points // 2)]))
    totals = [Counts()] * len(thresholds)
    for truth, detections in films:
        for pair in pair_frames(truth, detections, criterion):
            ignored, pair_scores = truth.ignored[pair.truths], detections.scores[pair.predictions]
            for k, threshold in enumerate(thresholds):
                kept = pair_scores >= threshold
                left = FramePair(pair.truths, pair.predictions[kept], pair.similarity[:, kept])
                rows, _, counting = settle(left, ignored, criterion.threshold)
                tp = len(rows)
                totals[k] += Counts(tp, int(counting.sum()) - tp, int((~ignored).sum()) - tp)
    return [CurvePoint(float(threshold), total) for threshold, total in zip(thresholds, totals, strict=True)]


def best_f1(curve: Sequence[CurvePoint]) -> CurvePoint:
    """The point of the greatest F1; of several, that of the highest threshold."""
    return max(curve, key=lambda point: (np.nan_to_num(point.counts.f1), point.threshold))
