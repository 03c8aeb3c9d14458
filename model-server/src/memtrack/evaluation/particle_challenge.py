# SPDX-License-Identifier: GPL-3.0-or-later
"""The measures of the Particle Tracking Challenge: alpha, beta, JSC, JSC of tracks, RMSE.

Chenouard et al., Nature Methods 11 (2014), supplementary note 3. The distance of two tracks is the sum over frames of
the distance of their points, at most the gate, and the gate where only one of them has a point. Truth tracks are paired
with predicted tracks, or with nothing, so that the total distance is least. alpha = 1 - d(X, Y) / d(X, nothing); beta
takes the predicted tracks without a partner from it. Gate 5 px in the challenge.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from memtrack.evaluation.assignment import assign
from memtrack.evaluation.matching import Comparison, ratio


@dataclass(frozen=True, slots=True)
class ChallengeSums:
    """What the measures are made of, in pixels and counts; the sums of films add up.

    none: distance of the truth to nothing. total: to the paired tracks. spurious: of unpaired predictions to nothing.
    """

    none: float = 0.0
    total: float = 0.0
    spurious: float = 0.0
    tp: int = 0
    fp: int = 0
    fn: int = 0
    squared_error: float = 0.0
    track_tp: int = 0
    track_fp: int = 0
    track_fn: int = 0

    def __add__(self, other: ChallengeSums) -> ChallengeSums:
        return ChallengeSums(*(getattr(self, entry.name) + getattr(other, entry.name) for entry in fields(self)))

    @property
    def measures(self) -> dict[str, float]:
        """Alpha, beta, JSC, JSC_tracks and RMSE_px; NaN where there is nothing to compare."""
        return {
            "alpha": ratio(self.none - self.total, self.none),
            "beta": ratio(self.none - self.total, self.none + self.spurious),
            "JSC": ratio(self.tp, self.tp + self.fp + self.fn),
            "JSC_tracks": ratio(self.track_tp, self.track_tp + self.track_fp + self.track_fn),
            "RMSE_px": ratio(self.squared_error, self.tp) ** 0.5,
        }


def challenge_sums(comparison: Comparison, gate_px: float = 5.0) -> ChallengeSums:
    """Sums of one film, every row of whose truth and predictions belongs to a track."""
    truth, predicted = comparison.truth, comparison.predicted
    truth_ids, truth_track = np.unique(truth.ids, return_inverse=True)
    predicted_ids, predicted_track, predicted_size = np.unique(predicted.ids, return_inverse=True, return_counts=True)
    shape = len(truth_ids), len(predicted_ids)
    common, gated, near, squared = (np.zeros(shape) for _ in range(4))
    for pair in comparison.pairs:
        distance = np.hypot(
            truth.x[pair.truths][:, None] - predicted.x[pair.predictions],
            truth.y[pair.truths][:, None] - predicted.y[pair.predictions],
        )
        cells = np.ix_(truth_track[pair.truths], predicted_track[pair.predictions])
        common[cells] += 1
        gated[cells] += np.minimum(distance, gate_px)
        near[cells] += distance < gate_px
        squared[cells] += np.where(distance < gate_px, distance**2, 0.0)
    # How much nearer a truth track is to its partner than to nothing: frames that only one has cost the gate.
    gain = 2 * gate_px * common - gated - gate_px * predicted_size
    chosen = assign(gain)
    tp = int(near[chosen].sum())
    none = gate_px * len(truth)
    return ChallengeSums(
        none=none,
        total=none - float(gain[chosen].sum()),
        spurious=gate_px * float(len(predicted) - predicted_size[chosen[1]].sum()),
        tp=tp,
        fp=len(predicted) - tp,
        fn=len(truth) - tp,
        squared_error=float(squared[chosen].sum()),
        track_tp=len(chosen[0]),
        track_fp=shape[1] - len(chosen[0]),
        track_fn=shape[0] - len(chosen[0]),
    )
