# SPDX-License-Identifier: GPL-3.0-or-later
"""Truth against tracks and detections, for one film and for all films together."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from jaxtyping import Float, Int8

from memtrack.detections import FrameDetections
from memtrack.evaluation.matching import Comparison, Counts, Criterion, compare
from memtrack.evaluation.particle_challenge import ChallengeSums, challenge_sums
from memtrack.evaluation.stages import candidate_steps, pruning_steps
from memtrack.evaluation.tracking_measures import TrackingSums, tracking_sums
from memtrack.film import Calibration
from memtrack.motility import SPEED_LAG_SECONDS, frames_in, lag_speed, mean_speed, track_motility
from memtrack.pruning import PrunerSettings
from memtrack.tracks import Motility, TrackTable


@dataclass(frozen=True, slots=True)
class Options:
    """How to evaluate.

    min_length: tracks that span fewer frames are dropped (paper: 60 in collagen, 30 in water; 1 keeps the tracks as
    they are given). sweep: the lengths of the length sweep. challenge_gate_px: gate of alpha, beta, JSC and RMSE.
    pruner: if given, the candidates are also followed through the pruner's filters.
    """

    criterion: Criterion = field(default_factory=Criterion)
    min_length: int = 1
    sweep: tuple[int, ...] = (5, 10, 15, 20, 25, 30, 40, 50, 60, 75, 90, 120)
    challenge_gate_px: float = 5.0
    pruner: PrunerSettings | None = None


@dataclass(frozen=True, slots=True)
class FilmData:
    """One film's truth, and what was found in it: tracks, candidates of the detector, or both."""

    name: str
    truth: TrackTable
    tracks: TrackTable | None = None
    candidates: Sequence[FrameDetections] | None = None
    calibration: Calibration = field(default_factory=Calibration)


@dataclass(frozen=True, slots=True)
class ClassCounts:
    """Truth tracks of one motility class, those of them that were detected, and the same for their points.

    A track counts as detected when at least half of its points are matched.
    """

    tracks: int = 0
    detected: int = 0
    points: int = 0
    found: int = 0

    def __add__(self, other: ClassCounts) -> ClassCounts:
        return ClassCounts(
            self.tracks + other.tracks,
            self.detected + other.detected,
            self.points + other.points,
            self.found + other.found,
        )


@dataclass(frozen=True, slots=True)
class Speeds:
    """Mean speed of each track in um/s, from frame to frame and over a lag of 0.1 s, and its motility class.

    Empty without calibration; NaN over the lag for a track that is too short. Tracks of one point are left out.
    """

    frame_to_frame: Float[np.ndarray, " tracks"] = field(default_factory=lambda: np.zeros(0))
    over_lag: Float[np.ndarray, " tracks"] = field(default_factory=lambda: np.zeros(0))
    motility: Int8[np.ndarray, " tracks"] = field(default_factory=lambda: np.zeros(0, np.int8))

    def __add__(self, other: Speeds) -> Speeds:
        columns = (np.concatenate([getattr(self, e.name), getattr(other, e.name)]) for e in fields(self))
        return Speeds(*columns)

    def of(self, motility: Motility) -> Speeds:
        """Those of the tracks of one class."""
        rows = self.motility == motility
        return Speeds(self.frame_to_frame[rows], self.over_lag[rows], self.motility[rows])

    @property
    def mean(self) -> float:
        """Mean over tracks of the speed from frame to frame."""
        return float(self.frame_to_frame.mean()) if len(self.frame_to_frame) else math.nan

    @property
    def standard_error(self) -> float:
        """Of that mean."""
        n = len(self.frame_to_frame)
        return float(self.frame_to_frame.std(ddof=1)) / math.sqrt(n) if n > 1 else math.nan

    @property
    def mean_over_lag(self) -> float:
        """Mean over tracks of the speed over the lag."""
        known = self.over_lag[np.isfinite(self.over_lag)]
        return float(known.mean()) if len(known) else math.nan


@dataclass(frozen=True, slots=True)
class Evaluation:
    """The sums of one film, or of several added up; ratios are taken last.

    steps: counts after each step, in the order of the pipeline; the last one is the result. predicted_tracks and
    false_tracks: tracks after the length filter, and those of them of whose points not half match a truth.
    """

    steps: dict[str, Counts]
    lengths: dict[int, Counts] = field(default_factory=dict)
    classes: dict[Motility, ClassCounts] = field(default_factory=dict)
    tracking: TrackingSums | None = None
    challenge: ChallengeSums | None = None
    truth_tracks: int = 0
    predicted_tracks: int = 0
    false_tracks: int = 0
    truth_speeds: Speeds = field(default_factory=Speeds)
    tracked_speeds: Speeds = field(default_factory=Speeds)

    @property
    def result(self) -> Counts:
        """Counts after the last step."""
        return list(self.steps.values())[-1]

    def __add__(self, other: Evaluation) -> Evaluation:
        return Evaluation(*(_sum(getattr(self, entry.name), getattr(other, entry.name)) for entry in fields(self)))


def _sum(first: Any, second: Any) -> Any:
    """Two values added; of dictionaries the values under each key; None stands for nothing."""
    if first is None or second is None:
        return second if first is None else first
    if isinstance(first, dict):
        return {key: _sum(first.get(key), second.get(key)) for key in {**first, **second}}
    return first + second


def evaluate(film: FilmData, options: Options) -> Evaluation:
    """Compare what was found in one film with its truth; both in pixels of the film and frames from 0.

    Without tracks only the detector's steps are counted; without candidates only the tracks.
    """
    steps = {
        name: compare(film.truth, found, options.criterion).counts for name, found in _detection_steps(film, options)
    }
    if film.tracks is None:
        return Evaluation(steps, truth_tracks=_tracks(film.truth.select(~film.truth.ignored)))
    sweep = _length_sweep(film.truth, film.tracks, (1, *options.sweep), options.criterion)
    steps["SORT"] = sweep[1]
    final = compare(film.truth, film.tracks.select(film.tracks.lengths >= options.min_length), options.criterion)
    if options.min_length > 1:
        steps["length"] = final.counts
    return Evaluation(
        steps,
        lengths=sweep,
        classes=_by_class(final, film),
        tracking=tracking_sums(final),
        challenge=challenge_sums(final, options.challenge_gate_px),
        truth_tracks=_tracks(final.truth),
        predicted_tracks=_tracks(final.predicted),
        false_tracks=sum(bool(2 * final.right[rows].sum() < rows.sum()) for _, rows in _track_rows(final.predicted)),
        truth_speeds=_speeds(final.truth, film.calibration),
        tracked_speeds=_speeds(final.predicted, film.calibration),
    )


def _length_sweep(
    truth: TrackTable, tracks: TrackTable, least_lengths: Sequence[int], criterion: Criterion
) -> dict[int, Counts]:
    """Counts by the least length of a track; longer ones drop more rows, so their number tells what is left."""
    spans, counted, sweep = tracks.lengths, dict[int, Counts](), dict[int, Counts]()
    for least in least_lengths:
        kept = spans >= least
        rows = int(kept.sum())
        if rows not in counted:
            counted[rows] = compare(truth, tracks.select(kept), criterion).counts
        sweep[least] = counted[rows]
    return sweep


def _detection_steps(film: FilmData, options: Options) -> Iterator[tuple[str, TrackTable]]:
    if film.candidates is not None:
        yield from candidate_steps(film.candidates)
        if options.pruner is not None:
            yield from pruning_steps(film.candidates, options.pruner)


def _tracks(table: TrackTable) -> int:
    return len(table.track_ids)


def _track_rows(table: TrackTable) -> Iterator[tuple[int, np.ndarray]]:
    for track_id in table.track_ids:
        yield track_id, table.ids == track_id


def _by_class(final: Comparison, film: FilmData) -> dict[Motility, ClassCounts]:
    """Which truth tracks were detected, by motility; the class is of the whole track, ignored points included."""
    classes = dict.fromkeys(Motility, ClassCounts())
    whole = {int(track.ids[0]): track for track in film.truth.tracks()}
    for track_id, rows in _track_rows(final.truth):
        found, points = int(final.found[rows].sum()), int(rows.sum())
        motility = track_motility(whole[track_id], film.calibration)
        classes[motility] += ClassCounts(1, int(2 * found >= points), points, found)
    return classes


def _speeds(table: TrackTable, calibration: Calibration) -> Speeds:
    pixel, interval = calibration.pixel_size_um, calibration.frame_interval_seconds
    if pixel is None or interval is None:
        return Speeds()
    lag = frames_in(SPEED_LAG_SECONDS, interval)
    moving = [track for track in table.tracks() if math.isfinite(mean_speed(track))]
    return Speeds(
        np.array([mean_speed(track) for track in moving]) * pixel / interval,
        np.array([lag_speed(track, lag) for track in moving]) * pixel / interval,
        np.array([track_motility(track, calibration) for track in moving], np.int8),
    )
