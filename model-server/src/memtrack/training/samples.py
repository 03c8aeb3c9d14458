# SPDX-License-Identifier: GPL-3.0-or-later
"""Training samples: the features of single frames, made by the method's own steps, with the bacteria in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, UInt8

from memtrack.background import split_drift
from memtrack.detections import Level
from memtrack.film import Film
from memtrack.motion import FeatureSpec, FilmFeatures
from memtrack.scene import Scene
from memtrack.stabilisation import measure_motion
from memtrack.tracks import Motility, TrackTable

X, Y, LEVEL, IGNORED = range(4)


@dataclass(frozen=True, slots=True)
class FilmSamples:
    """Frames of one film: features, and for each frame rows (x, y, level, ignored) on the grid of the features."""

    features: UInt8[np.ndarray, "frame channel y x"]
    truth: tuple[Float32[np.ndarray, "_ 4"], ...]
    family: str = "film"

    def __len__(self) -> int:
        return len(self.truth)


def level_of(motility: int) -> Level:
    """The detector that learns bacteria of this motility; the non-motile go to LOW, as in the authors' code."""
    return {Motility.MEDIUM: Level.MEDIUM, Motility.HIGH: Level.HIGH}.get(Motility(motility), Level.LOW)


def extract(
    film: Film,
    truth: TrackTable,
    spec: FeatureSpec,
    *,
    frames: int,
    rng: np.random.Generator,
    stabilise: bool = True,
    family: str = "film",
) -> FilmSamples:
    """Features and truth of `frames` frames of a film drawn at random, its first always among them if there are 8."""
    motion = measure_motion(film, stabilise=stabilise, report=_silent)
    made = FilmFeatures(Scene(film, motion, report=_silent), spec)
    count = film.frame_count
    chosen = np.sort(rng.choice(count, min(frames, count), replace=False))
    if len(chosen) >= 8:
        chosen[0] = 0
    features, rows = [], []
    for i in chosen:
        features.append(made.frame(int(i)))
        at = np.flatnonzero(truth.frames == i)
        rest = split_drift(motion.drift[i])[1]
        levels = [level_of(int(m)) for m in truth.motility[at]]
        columns = (truth.x[at] - rest[0], truth.y[at] - rest[1], levels, truth.ignored[at])
        rows.append(np.stack([np.asarray(c, np.float32) for c in columns], axis=1))
    return FilmSamples(np.stack(features), tuple(rows), family)


def _silent(done: int, total: int) -> None:
    pass
