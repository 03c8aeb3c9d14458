# SPDX-License-Identifier: GPL-3.0-or-later
"""How well identities are kept: HOTA, IDF1 and MOTA.

HOTA with DetA, AssA, LocA: Luiten et al., IJCV 129 (2021); means over the similarity thresholds 0.05, 0.10 ... 0.95.
IDF1: Ristani et al., ECCV Workshops (2016). MOTA: Bernardin and Stiefelhagen, JIVP (2008).
The similarity is the criterion's: IoU of the boxes, or 1 - distance / gate of the centres. IDF1 and MOTA count a pair
as a match where the similarity exceeds the criterion's threshold. Sums of several films add up before ratios are taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields

import numpy as np
from jaxtyping import Float, Int

from memtrack.evaluation.assignment import assign
from memtrack.evaluation.matching import Comparison, FramePair, ratio

ALPHAS = np.arange(1, 20) / 20


def _zeros() -> Float[np.ndarray, " alphas"]:
    return np.zeros(len(ALPHAS))


@dataclass(frozen=True, slots=True)
class TrackingSums:
    """What HOTA, IDF1 and MOTA are made of; arrays have one value a threshold of `ALPHAS`.

    association: sum over the true positives of their track pair's Jaccard index. localisation: sum of similarities.
    identity_tp: points matched under the best one-to-one pairing of whole tracks. switches: of identity.
    """

    truths: int = 0
    predictions: int = 0
    hota_tp: Float[np.ndarray, " alphas"] = field(default_factory=_zeros)
    association: Float[np.ndarray, " alphas"] = field(default_factory=_zeros)
    localisation: Float[np.ndarray, " alphas"] = field(default_factory=_zeros)
    identity_tp: int = 0
    matches: int = 0
    switches: int = 0

    def __add__(self, other: TrackingSums) -> TrackingSums:
        return TrackingSums(*(getattr(self, entry.name) + getattr(other, entry.name) for entry in fields(self)))

    @property
    def measures(self) -> dict[str, float]:
        """HOTA, DetA, AssA, LocA, IDF1 and MOTA; NaN where there is nothing to compare."""
        if not self.truths and not self.predictions:
            return dict.fromkeys(("HOTA", "DetA", "AssA", "LocA", "IDF1", "MOTA"), np.nan)
        found = np.maximum(self.hota_tp, 1)
        detection = self.hota_tp / (self.truths + self.predictions - self.hota_tp)
        association = self.association / found
        # A threshold without any match says nothing of the localisation and counts as 1, as in the reference code.
        localisation = np.where(self.hota_tp > 0, self.localisation / found, 1.0)
        errors = self.truths - self.matches + self.predictions - self.matches + self.switches
        return {
            "HOTA": float(np.sqrt(detection * association).mean()),
            "DetA": float(detection.mean()),
            "AssA": float(association.mean()),
            "LocA": float(localisation.mean()),
            "IDF1": 2 * self.identity_tp / (self.truths + self.predictions),
            "MOTA": 1 - ratio(errors, self.truths),
        }


def tracking_sums(comparison: Comparison) -> TrackingSums:
    """Sums of one film, every row of whose truth and predictions belongs to a track."""
    truth, predicted, pairs, threshold = comparison.truth, comparison.predicted, comparison.pairs, comparison.threshold
    truth_ids, truth_track, truth_size = np.unique(truth.ids, return_inverse=True, return_counts=True)
    predicted_ids, predicted_track, predicted_size = np.unique(predicted.ids, return_inverse=True, return_counts=True)
    shape = len(truth_ids), len(predicted_ids)
    together, alignment = np.zeros(shape), np.zeros(shape)
    for pair in pairs:
        cells = np.ix_(truth_track[pair.truths], predicted_track[pair.predictions])
        together[cells] += pair.similarity > threshold
        crowd = pair.similarity.sum(axis=0) + pair.similarity.sum(axis=1)[:, None] - pair.similarity
        alignment[cells] += np.divide(pair.similarity, crowd, out=np.zeros_like(crowd), where=crowd > 0)
    sizes = truth_size[:, None] + predicted_size
    alignment /= np.maximum(sizes - alignment, 1e-12)

    links, similarities = [np.zeros(0, np.int64)], [np.zeros(0)]
    for pair in pairs:
        first, second = truth_track[pair.truths], predicted_track[pair.predictions]
        rows, columns = assign(alignment[np.ix_(first, second)] * pair.similarity)
        links.append(first[rows] * shape[1] + second[columns])
        similarities.append(pair.similarity[rows, columns])
    link, similarity = np.concatenate(links), np.concatenate(similarities)
    hota_tp, association, localisation = _zeros(), _zeros(), _zeros()
    for k in range(len(ALPHAS)):
        hit = similarity >= ALPHAS[k] - np.finfo(float).eps
        linked, shared = np.unique(link[hit], return_counts=True)
        hota_tp[k] = hit.sum()
        association[k] = (shared * shared / (sizes.ravel()[linked] - shared)).sum()
        localisation[k] = similarity[hit].sum()
    matches, switches = _clear(pairs, truth_track, predicted_track, shape[0], threshold)
    return TrackingSums(
        truths=len(truth),
        predictions=len(predicted),
        hota_tp=hota_tp,
        association=association,
        localisation=localisation,
        identity_tp=int(together[assign(together)].sum()),
        matches=matches,
        switches=switches,
    )


def _clear(
    pairs: Sequence[FramePair],
    truth_track: Int[np.ndarray, " truths"],
    predicted_track: Int[np.ndarray, " predictions"],
    tracks: int,
    threshold: float,
) -> tuple[int, int]:
    """Matches and identity switches of MOTA: a pair of the frame before is kept as long as it matches."""
    latest, previous = np.full(tracks, -1), np.full(tracks, -1)
    matches = switches = 0
    for pair in pairs:
        first, second = truth_track[pair.truths], predicted_track[pair.predictions]
        if not len(first) or not len(second):
            continue
        kept = second == previous[first][:, None]
        rows, columns = assign(np.where(pair.similarity > threshold, 1000.0 * kept + pair.similarity, 0.0))
        found, by = first[rows], second[columns]
        switches += int(((latest[found] >= 0) & (latest[found] != by)).sum())
        matches += len(rows)
        latest[found] = by
        previous[:] = -1
        previous[found] = by
    return matches, switches
