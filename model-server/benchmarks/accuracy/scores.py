# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured of the tracks of a film, and the tables of it in Markdown."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from memtrack.evaluation.matching import Comparison, Criterion, compare, match
from memtrack.evaluation.tracking_measures import tracking_sums
from memtrack.tracks import TrackTable

LONG = 60
"""Frames that a track on an empty film must span to be counted as a false one."""
NET_FRAMES = 5


@dataclass(frozen=True, slots=True)
class Scores:
    """One method on one film; NaN where there is nothing to measure.

    precision, recall, f1: the paper's measure, one to one, IoU > 0.1 of boxes of 30 px where there are none. hota: by
    the same overlap. rms_px: of the distance of matched centres. f1_near: F1 of centres nearer than 6 px. long_tracks:
    those of 60 frames and more. speed_ratio, net_speed_ratio: mean speed of the tracks, from frame to frame and over 5
    frames, to that of the true tracks they belong to. how: our model, or the settings that were tuned on the truth.
    """

    precision: float
    recall: float
    f1: float
    hota: float
    rms_px: float
    f1_near: float
    tracks: int
    long_tracks: int
    speed_ratio: float
    net_speed_ratio: float
    how: str = ""


def score(truth: TrackTable, tracks: TrackTable, how: str = "") -> Scores:
    """All measures of the tracks of one film."""
    found = compare(truth, tracks, Criterion())
    counts = found.counts
    first = np.unique(tracks.ids, return_index=True)[1]
    return Scores(
        counts.precision,
        counts.recall,
        counts.f1,
        tracking_sums(found).measures["HOTA"],
        _rms(found),
        compare(truth, tracks, Criterion(distance_px=6.0)).counts.f1,
        len(first),
        int((tracks.lengths[first] >= LONG).sum()),
        *_speed_ratios(found),
        how,
    )


def _matches(found: Comparison) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Rows of the truths and predictions that belong together, frame by frame."""
    for pair in found.pairs:
        rows, columns = match(pair.similarity, found.threshold)
        yield pair.truths[rows], pair.predictions[columns]


def _rms(found: Comparison) -> float:
    squares = [
        (found.truth.x[t] - found.predicted.x[p]) ** 2 + (found.truth.y[t] - found.predicted.y[p]) ** 2
        for t, p in _matches(found)
    ]
    together = np.concatenate([*squares, np.zeros(0)])
    return float(np.sqrt(together.mean())) if len(together) else math.nan


def _speed_ratios(found: Comparison) -> tuple[float, float]:
    """Mean over tracks of their mean speed, divided by the same of the true tracks most of their points belong to."""
    owner: dict[int, list[int]] = {}
    for truths, predictions in _matches(found):
        for t, p in zip(found.truth.ids[truths], found.predicted.ids[predictions], strict=True):
            owner.setdefault(int(p), []).append(int(t))
    predicted = {int(track.ids[0]): track for track in found.predicted.tracks()}
    true = {int(track.ids[0]): track for track in found.truth.tracks()}
    pairs = [(predicted[p], true[max(set(of), key=of.count)]) for p, of in owner.items()]
    ratios = []
    for lag in (1, NET_FRAMES):
        speeds = np.array([[_speed(track, lag) for track in pair] for pair in pairs]).reshape(-1, 2)
        ours, theirs = speeds[np.isfinite(speeds).all(axis=1)].sum(axis=0)
        ratios.append(float(ours / theirs) if theirs else math.nan)
    return ratios[0], ratios[1]


def _speed(track: TrackTable, lag: int) -> float:
    """Mean distance in pixels a frame between points `lag` frames apart; NaN without any."""
    later = np.searchsorted(track.frames, track.frames + lag)
    known = later < len(track)
    known[known] = track.frames[later[known]] == track.frames[known] + lag
    steps = np.hypot(track.x[later[known]] - track.x[known], track.y[later[known]] - track.y[known])
    return float(steps.mean() / lag) if len(steps) else math.nan


@dataclass(frozen=True, slots=True)
class Examined:
    """A film, what it shows, counted cells a frame (0: it is empty), and the scores of each method on it.

    fingerprint: of its pixels and its truth, so that scores of another film of that name are not taken for its own.
    """

    name: str
    shows: str
    cells: float
    fingerprint: str
    scores: Mapping[str, Scores]


OURS = "MEMTrack"
_HEAD = ["film", "shows", "cells a frame"]
_COLUMNS: dict[str, Callable[[Scores], str]] = {
    "precision": lambda s: _number(s.precision),
    "recall": lambda s: _number(s.recall),
    "F1": lambda s: _number(s.f1),
    "HOTA": lambda s: _number(s.hota),
    "centre RMS": lambda s: f"{_number(s.rms_px, 2)} px",
    "F1 within 6 px": lambda s: _number(s.f1_near),
    "speed, frame to frame": lambda s: _percent(s.speed_ratio),
    "speed over 5 frames": lambda s: _percent(s.net_speed_ratio),
}


def tables(films: Sequence[Examined]) -> str:
    """Everything in Markdown: our measures, all methods side by side, and the empty films."""
    full = [film for film in films if film.cells]
    ours = [film for film in full if OURS in film.scores]
    rows = [[*_head(film), *(show(film.scores[OURS]) for show in _COLUMNS.values())] for film in ours]
    models = " and ".join(sorted({film.scores[OURS].how for film in films if OURS in film.scores}))
    parts = [f"{OURS} with {models}:", _table([*_HEAD, *_COLUMNS], rows)] if ours else []
    methods = sorted(dict.fromkeys(method for film in full for method in film.scores), key=lambda m: m != OURS)
    if len(methods) > 1:
        rows = [[film.name, *(_pair(film.scores.get(method)) for method in methods)] for film in full]
        shared = [film for film in full if set(methods) <= set(film.scores)]
        if len(shared) > 1:
            rows.append([f"mean of {len(shared)}", *(_mean([film.scores[m] for film in shared]) for m in methods)])
        parts.append(_table(["F1 / HOTA", *methods], rows))
    empty = [film for film in films if not film.cells and OURS in film.scores]
    if empty:
        rows = [[f.name, f.shows, str(f.scores[OURS].tracks), str(f.scores[OURS].long_tracks)] for f in empty]
        parts.append(_table(["film without cells", "shows", "tracks", f"tracks of {LONG} frames"], rows))
    return "\n\n".join(parts) + "\n"


def _head(film: Examined) -> list[str]:
    return [film.name, film.shows, f"{film.cells:.0f}"]


def _pair(scores: Scores | None) -> str:
    return "" if scores is None else f"{_number(scores.f1)} / {_number(scores.hota)}"


def _mean(scores: Sequence[Scores]) -> str:
    """Of the F1 and of the HOTA; a method without any track has 0 in both."""
    f1, hota = (np.nan_to_num([getattr(s, name) for s in scores]).mean() for name in ("f1", "hota"))
    return f"{_number(f1)} / {_number(hota)}"


def _number(value: float, digits: int = 3) -> str:
    return "-" if math.isnan(value) else f"{value:.{digits}f}"


def _percent(ratio: float) -> str:
    return "-" if math.isnan(ratio) else f"{100 * (ratio - 1):+.1f} %"


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
