# SPDX-License-Identifier: GPL-3.0-or-later
"""Which truth each prediction of a frame belongs to, and the counts that follow: the paper's measure.

Paper section "Evaluation Metrics"; the authors' code lets several truths match one prediction, here the match is one
to one, as many pairs as possible and among those the most similar ones.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from memtrack.boxes import pairwise_iou
from memtrack.evaluation.assignment import assign
from memtrack.tracks import TrackTable


@dataclass(frozen=True, slots=True)
class Criterion:
    """When a prediction is right, and how alike it then is.

    iou: boxes match when their intersection over union exceeds this; similarity is that IoU.
    distance_px: if given, centres match when nearer than this instead; similarity is 1 - distance / distance_px.
    box_size_px: edge of the square box of a row that has none (30 in the paper).
    """

    iou: float = 0.1
    distance_px: float | None = None
    box_size_px: float = 30.0

    @property
    def threshold(self) -> float:
        """The similarity a match must exceed."""
        return self.iou if self.distance_px is None else 0.0

    def __str__(self) -> str:
        if self.distance_px is None:
            return f"IoU > {self.iou:g}, boxes of {self.box_size_px:g} px where a file has none"
        return f"centres nearer than {self.distance_px:g} px"


@dataclass(frozen=True, slots=True)
class Counts:
    """True positives, false positives and false negatives; add those of frames and films before taking ratios."""

    tp: int = 0
    fp: int = 0
    fn: int = 0

    def __add__(self, other: Counts) -> Counts:
        return Counts(self.tp + other.tp, self.fp + other.fp, self.fn + other.fn)

    @property
    def precision(self) -> float:
        """TP / (TP + FP); NaN without predictions."""
        return ratio(self.tp, self.tp + self.fp)

    @property
    def recall(self) -> float:
        """TP / (TP + FN); NaN without truths."""
        return ratio(self.tp, self.tp + self.fn)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall; NaN without truths and predictions."""
        return ratio(2 * self.tp, 2 * self.tp + self.fp + self.fn)


def ratio(part: float, whole: float) -> float:
    """part / whole, NaN where there is no whole."""
    return part / whole if whole else math.nan


@dataclass(frozen=True, slots=True)
class FramePair:
    """Truths and predictions of one frame: their rows in the two tables, and how alike each pair is."""

    truths: Int[np.ndarray, " truths"]
    predictions: Int[np.ndarray, " predictions"]
    similarity: Float[np.ndarray, "truths predictions"]


def pair_frames(truth: TrackTable, predicted: TrackTable, criterion: Criterion) -> Iterator[FramePair]:
    """Compare the tables frame by frame, in every frame in which either has a row, in order."""
    if criterion.distance_px is None:
        truth_boxes = truth.with_boxes(criterion.box_size_px).boxes
        predicted_boxes = predicted.with_boxes(criterion.box_size_px).boxes
    frames = np.union1d(truth.frames, predicted.frames)
    for first, second in zip(_rows(truth, frames), _rows(predicted, frames), strict=True):
        if criterion.distance_px is None:
            similarity = pairwise_iou(truth_boxes[first], predicted_boxes[second])
        else:
            distance = np.hypot(truth.x[first, None] - predicted.x[second], truth.y[first, None] - predicted.y[second])
            similarity = np.maximum(0.0, 1.0 - distance / criterion.distance_px)
        yield FramePair(first, second, similarity)


def _rows(table: TrackTable, frames: Int[np.ndarray, " frames"]) -> list[Int[np.ndarray, " rows"]]:
    order = np.argsort(table.frames, kind="stable")
    return np.split(order, np.searchsorted(table.frames[order], frames[1:]))[: len(frames)]


def match(
    similarity: Float[np.ndarray, "n m"], threshold: float
) -> tuple[Int[np.ndarray, " k"], Int[np.ndarray, " k"]]:
    """Rows and columns of the pairs above the threshold: as many pairs as possible, then the most similar."""
    most = 1 + min(similarity.shape)
    return assign(np.where(similarity > threshold, most + similarity, 0.0))


def settle(
    pair: FramePair, ignored: Bool[np.ndarray, " truths"], threshold: float
) -> tuple[Int[np.ndarray, " k"], Int[np.ndarray, " k"], Bool[np.ndarray, " predictions"]]:
    """Judge one frame: places of the matched truths and predictions, and which predictions count at all.

    Predictions are first matched to the truths that count; one that matches none of these and lies on an `ignored`
    truth is neither right nor wrong.
    """
    real = np.flatnonzero(~ignored)
    rows, columns = match(pair.similarity[real], threshold)
    counting = ~(pair.similarity[ignored] > threshold).any(axis=0)
    counting[columns] = True
    return real[rows], columns, counting


@dataclass(frozen=True, slots=True)
class Comparison:
    """A truth and predictions of one film, freed of what is neither right nor wrong, paired frame by frame.

    found: whether a prediction matches the row of the truth; right: whether the prediction matches a truth.
    """

    truth: TrackTable
    predicted: TrackTable
    pairs: tuple[FramePair, ...]
    threshold: float
    found: Bool[np.ndarray, " truths"]
    right: Bool[np.ndarray, " predictions"]

    @property
    def counts(self) -> Counts:
        """The paper's measure: matches summed over frames."""
        tp = int(self.found.sum())
        return Counts(tp, len(self.predicted) - tp, len(self.truth) - tp)


def compare(truth: TrackTable, predicted: TrackTable, criterion: Criterion) -> Comparison:
    """Match the predictions of one film to its truth; see `settle` for ignored rows of the truth."""
    pairs = list(pair_frames(truth, predicted, criterion))
    found, right, counting = (np.zeros(n, np.bool_) for n in (len(truth), len(predicted), len(predicted)))
    for pair in pairs:
        rows, columns, counts = settle(pair, truth.ignored[pair.truths], criterion.threshold)
        found[pair.truths[rows]] = True
        right[pair.predictions[columns]] = True
        counting[pair.predictions[counts]] = True
    real = ~truth.ignored
    return Comparison(
        truth.select(real),
        predicted.select(counting),
        tuple(_kept(pairs, real, counting)),
        criterion.threshold,
        found[real],
        right[counting],
    )


def _kept(
    pairs: Iterable[FramePair], real: Bool[np.ndarray, " truths"], counting: Bool[np.ndarray, " predictions"]
) -> Iterator[FramePair]:
    """The same frames with only the rows that count, numbered as in the tables of these rows."""
    new_truth, new_prediction = np.cumsum(real) - 1, np.cumsum(counting) - 1
    for pair in pairs:
        rows, columns = real[pair.truths], counting[pair.predictions]
        if rows.any() or columns.any():
            yield FramePair(
                new_truth[pair.truths[rows]],
                new_prediction[pair.predictions[columns]],
                pair.similarity[np.ix_(rows, columns)],
            )
