# SPDX-License-Identifier: GPL-3.0-or-later
"""Scores that are probabilities, and thresholds for the paper's two criteria, from validation films."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from memtrack.boxes import non_maximum_suppression
from memtrack.detections import Detections, Level
from memtrack.detector import Decoder, Engine, detect
from memtrack.refinement import Refiner, refined
from memtrack.training.samples import IGNORED, LEVEL, FilmSamples, X, Y

MATCH_PX = 8.0
"""A detection is right when its centre is this near a bacterium's: stricter than the paper's IoU 0.1 (24 px)."""
LEAST_CALIBRATED = 20
"""Right detections, and wrong ones, that a calibration needs."""
LEAST_SLOPE = 0.2
SURE_PRECISION = 0.98
EVEN_F1 = 0.003
"""Differences of F1 below this are nothing. Of bounds that are even the lowest is taken: what it finds besides, the
track filter can still drop, and what a bound drops nothing brings back."""


@dataclass(frozen=True, slots=True)
class Scored:
    """Detections of all validation frames in one list, ignored ones left out, and how many bacteria there were.

    found: right or wrong. error: distance of a right one from its bacterium in pixels, NaN for a wrong one.
    truths: bacteria of each level. true_level: level of the bacterium found, -1 for a wrong detection.
    """

    scores: Float32[np.ndarray, " n"]
    levels: Int[np.ndarray, " n"]
    found: Bool[np.ndarray, " n"]
    error: Float[np.ndarray, " n"]
    true_level: Int[np.ndarray, " n"]
    truths: Int[np.ndarray, " levels"]
    frames: int


@dataclass(frozen=True, slots=True)
class Curve:
    """Precision and recall at each threshold, thresholds falling."""

    thresholds: Float[np.ndarray, " n"]
    precision: Float[np.ndarray, " n"]
    recall: Float[np.ndarray, " n"]

    @property
    def f1(self) -> Float[np.ndarray, " n"]:
        """Harmonic mean of precision and recall."""
        f1: np.ndarray = 2 * self.precision * self.recall / np.maximum(self.precision + self.recall, 1e-9)
        return f1


def score_films(
    films: Sequence[FilmSamples], engine: Engine, decoder: Decoder, refiner: Refiner | None = None, nms_iou: float = 0.7
) -> Scored:
    """Runs the detector, and the refiner if there is one, on every frame of `films` and matches boxes to bacteria."""
    parts: list[tuple[np.ndarray, ...]] = []
    truths, frames = np.zeros(len(Level), np.int64), 0
    for film in films:
        for features, truth in zip(film.features, film.truth, strict=True):
            found = detect(engine, decoder, np.ascontiguousarray(features))
            if refiner is not None:
                found = refined(found, features, refiner)
            found = found.select(non_maximum_suppression(found.boxes, found.scores, nms_iou))
            parts.append(match(found, truth))
            truths += np.bincount(truth[truth[:, IGNORED] == 0, LEVEL].astype(int), minlength=len(Level))
            frames += 1
    scores, levels, found_, error, true_level = (np.concatenate(c) for c in zip(*parts, strict=True))
    return Scored(scores, levels, found_, error, true_level, truths, frames)


def match(found: Detections, truth: Float32[np.ndarray, "n 4"]) -> tuple[np.ndarray, ...]:
    """Best scored first, each detection takes the nearest free bacterium within `MATCH_PX`; those that take an ignored
    one are left out."""
    centres = found.centres
    right, keep = np.zeros(len(found), bool), np.ones(len(found), bool)
    error, level = np.full(len(found), np.nan), np.full(len(found), -1)
    free = np.ones(len(truth), bool)
    for i in np.argsort(-found.scores, kind="stable"):
        if not len(truth):
            break
        distance = np.hypot(truth[:, X] - centres[i, 0], truth[:, Y] - centres[i, 1])
        real = np.where(free & (truth[:, IGNORED] == 0), distance, np.inf)
        k = int(real.argmin())
        if real[k] <= MATCH_PX:
            right[i], error[i], level[i], free[k] = True, real[k], int(truth[k, LEVEL]), False
        elif np.where(truth[:, IGNORED] > 0, distance, np.inf).min() <= 1.5 * MATCH_PX:
            keep[i] = False
    return found.scores[keep], found.levels[keep].astype(int), right[keep], error[keep], level[keep]


def calibration(scores: Float32[np.ndarray, " n"], found: Bool[np.ndarray, " n"]) -> tuple[float, float]:
    """Slope and offset that turn the logits of scores into probabilities of being right (Platt 1999), by Newton's
    method; 1 and 0, which leave the scores as they are, where there are too few to tell or higher scores are hardly
    righter."""
    if min(found.sum(), (~found).sum()) < LEAST_CALIBRATED:
        return 1.0, 0.0
    x = np.stack([_logit(scores), np.ones(len(scores))], axis=1)
    y = found.astype(np.float64)
    weights = np.array([1.0, 0.0])
    for _ in range(30):
        fit = _sigmoid(x @ weights)
        curvature = (x * (fit * (1 - fit))[:, None]).T @ x + 1e-6 * np.eye(2)
        step = np.linalg.solve(curvature, x.T @ (y - fit))
        weights = weights + np.clip(step, -1, 1)
        if np.abs(step).max() < 1e-8:
            break
    slope, offset = (float(weight) for weight in weights)
    return (slope, offset) if slope > LEAST_SLOPE else (1.0, 0.0)


def curve(scored: Scored, level: Level | None = None) -> Curve:
    """Precision and recall of one level's detector, or of all together.

    The bacteria a level's detector could have found are those it did find at any score, and those of its level that
    no detector found.
    """
    order = np.argsort(-scored.scores, kind="stable")
    scores, found = scored.scores[order], scored.found[order]
    if level is None:
        mine, total = np.ones(len(order), bool), int(scored.truths.sum())
    else:
        mine = scored.levels[order] == level
        missed = scored.truths[level] - (scored.true_level == level).sum()
        total = int((found & mine).sum() + missed)
    right, wrong = np.cumsum(found & mine), np.cumsum(~found & mine)
    last = np.flatnonzero(np.diff(scores, append=-1))
    precision = right[last] / np.maximum(right[last] + wrong[last], 1)
    return Curve(scores[last].astype(float), precision, right[last] / max(total, 1))


def choose(scored: Scored) -> dict[str, tuple[float, ...]]:
    """Thresholds of the levels for each criterion.

    Each level's scores are turned into the probability of being right that they had on these films, and one bound on
    that probability holds for all levels: so none is asked for more than another. max_f1: the lowest bound whose F1
    over all levels is within `EVEN_F1` of the highest. max_precision: precision alone is highest where almost nothing
    is found, so it is the lowest bound above the one of the best F1 with a precision of `SURE_PRECISION`, or with the
    best precision among those that keep three quarters of its recall.
    """
    fits = {level: _level_fit(scored, level) for level in Level}
    slopes, offsets = (np.array([fits[level][k] for level in Level]) for k in range(2))
    probability = _sigmoid(slopes[scored.levels] * _logit(scored.scores) + offsets[scored.levels])
    bounds = _bounds(curve(replace(scored, scores=probability.astype(np.float32))))
    return {
        criterion: tuple(float(t) for t in _sigmoid((_logit(np.full(len(Level), bound)) - offsets) / slopes))
        for criterion, bound in bounds.items()
    }


def _bounds(pooled: Curve) -> dict[str, float]:
    if not len(pooled.thresholds):
        return {"max_precision": 0.5, "max_f1": 0.5}
    best = int(pooled.f1.argmax())
    even = int(np.flatnonzero(pooled.f1 >= pooled.f1[best] - EVEN_F1).max())
    stricter = np.arange(best + 1)
    sure = stricter[pooled.precision[: best + 1] >= SURE_PRECISION]
    useful = stricter[pooled.recall[: best + 1] >= 0.75 * pooled.recall[best]]
    kept = np.intersect1d(sure, useful)
    strict = int(kept.max()) if len(kept) else int(useful[pooled.precision[useful].argmax()])
    return {"max_precision": float(pooled.thresholds[strict]), "max_f1": float(pooled.thresholds[even])}


def _level_fit(scored: Scored, level: Level) -> tuple[float, float]:
    mine = scored.levels == level
    return calibration(scored.scores[mine], scored.found[mine])


def _logit(p: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    clipped = np.clip(np.asarray(p, np.float64), 1e-6, 1 - 1e-6)
    logit: np.ndarray = np.log(clipped / (1 - clipped))
    return logit


def _sigmoid(x: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    probability: np.ndarray = 1 / (1 + np.exp(-x))
    return probability
