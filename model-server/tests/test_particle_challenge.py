# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from memtrack.evaluation.matching import Criterion, compare
from memtrack.evaluation.particle_challenge import ChallengeSums, challenge_sums
from memtrack.tracks import TrackTable

Track = dict[int, tuple[float, float]]


def table(tracks: list[Track]) -> TrackTable:
    rows = [(frame, number, *xy) for number, track in enumerate(tracks) for frame, xy in track.items()]
    frames, ids, x, y = np.array(rows, float).reshape(-1, 4).T
    return TrackTable.of(frames, ids, x, y)


def measures(truth: list[Track], predicted: list[Track], gate: float = 5.0) -> dict[str, float]:
    return challenge_sums(compare(table(truth), table(predicted), Criterion()), gate).measures


def by_definition(truth: list[Track], predicted: list[Track], gate: float) -> dict[str, float]:
    """The definitions of the challenge written out, every pairing tried."""

    def distance(first: Track, second: Track) -> float:
        total = 0.0
        for frame in set(first) | set(second):
            if frame in first and frame in second:
                total += min(gate, math.dist(first[frame], second[frame]))
            else:
                total += gate
        return total

    nothing: list[Track] = [{} for _ in truth]
    # Of pairings that are equally good the one with the fewest pairs: a partner that is no nearer than nothing is none.
    best = min(
        itertools.permutations([*predicted, *nothing], len(truth)),
        key=lambda chosen: (
            round(sum(distance(a, b) for a, b in zip(truth, chosen, strict=True)), 9),
            sum(bool(track) for track in chosen),
        ),
    )
    none = sum(distance(track, {}) for track in truth)
    total = sum(distance(a, b) for a, b in zip(truth, best, strict=True))
    spurious = [track for track in predicted if not any(track is chosen for chosen in best)]
    wrong = sum(distance(track, {}) for track in spurious)
    near = [
        math.dist(a[frame], b[frame])
        for a, b in zip(truth, best, strict=True)
        for frame in set(a) & set(b)
        if math.dist(a[frame], b[frame]) < gate
    ]
    points, found = sum(map(len, truth)), sum(map(len, predicted))
    paired = sum(bool(chosen) for chosen in best)
    return {
        "alpha": 1 - total / none,
        "beta": (none - total) / (none + wrong),
        "JSC": len(near) / (points + found - len(near)),
        "JSC_tracks": paired / (len(truth) + len(spurious)),
        "RMSE_px": math.sqrt(sum(d * d for d in near) / len(near)) if near else math.nan,
    }


def test_a_shifted_track_a_half_track_and_a_false_one_by_hand() -> None:
    truth: list[Track] = [{t: (10.0 * t, 0.0) for t in range(4)}, {t: (10.0 * t, 50.0) for t in range(4)}]
    predicted: list[Track] = [
        {t: (10.0 * t + 3, 4.0) for t in range(4)} | {1: (10.0, 1.0)},  # 5 px off, the gate itself, but for frame 1
        {t: (10.0 * t, 52.0) for t in range(3)},
        {0: (200.0, 200.0), 1: (200.0, 200.0)},
    ]
    # Truth to nothing 8 x 5 = 40. Pairs: 5 + 1 + 5 + 5 = 16 and 2 + 2 + 2 + 5 = 11; spurious 2 x 5 = 10.
    assert measures(truth, predicted) == pytest.approx(
        {"alpha": 1 - 27 / 40, "beta": 13 / 50, "JSC": 4 / 13, "JSC_tracks": 2 / 3, "RMSE_px": math.sqrt(13 / 4)}
    )


@pytest.mark.parametrize("seed", range(25))
def test_measures_follow_the_definitions_in_random_worlds(seed: int) -> None:
    rng = np.random.default_rng(seed)

    def world(count: int) -> list[Track]:
        tracks: list[Track] = []
        for _ in range(count):
            first, last = np.sort(rng.integers(0, 9, 2))
            start = rng.uniform(0, 12, 2)
            frames = [int(t) for t in range(first, last + 1) if rng.random() < 0.8] or [int(first)]
            tracks.append({t: (float(start[0] + rng.normal()), float(start[1] + 0.7 * t)) for t in frames})
        return tracks

    truth, predicted = world(int(rng.integers(1, 4))), world(int(rng.integers(1, 5)))
    expected = by_definition(truth, predicted, 4.0)
    assert measures(truth, predicted, 4.0) == pytest.approx(expected, nan_ok=True)


def test_the_truth_itself_is_perfect_and_nothing_is_nothing() -> None:
    truth: list[Track] = [{0: (1.0, 2.0), 1: (3.0, 4.0)}, {5: (9.0, 9.0)}]
    assert measures(truth, truth) == {"alpha": 1, "beta": 1, "JSC": 1, "JSC_tracks": 1, "RMSE_px": 0}
    none = measures(truth, [])
    assert (none["alpha"], none["beta"], none["JSC"], none["JSC_tracks"]) == (0, 0, 0, 0)
    assert all(math.isnan(value) for value in ChallengeSums().measures.values())
