# SPDX-License-Identifier: GPL-3.0-or-later
"""Batches of crops with random flips, contrast inversion, gain and noise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float32, UInt8

from memtrack.motion import NEUTRAL, FeatureSpec
from memtrack.training.loss import LossSettings, targets
from memtrack.training.samples import FilmSamples, X, Y


class Batches:
    """Draws crops: films, then frames evenly, then a place, more often one that holds a bacterium."""

    def __init__(
        self,
        films: Sequence[FilmSamples],
        spec: FeatureSpec,
        *,
        crop: int,
        size: int,
        stride: int,
        loss: LossSettings,
        weights: Sequence[float] | None = None,
    ) -> None:
        self.films, self.crop, self.size, self.stride, self.loss = films, crop, size, stride, loss
        self.signed = np.array([c == "grey" or c.startswith("deviation") for c in spec.channels])
        chances = np.ones(len(films)) if weights is None else np.asarray(weights, np.float64)
        self.chances = chances / chances.sum()

    def draw(
        self, rng: np.random.Generator
    ) -> tuple[UInt8[np.ndarray, "n channel crop crop"], Float32[np.ndarray, "n 5 y x"]]:
        """The next batch: features and target maps."""
        pairs = [self._crop(rng) for _ in range(self.size)]
        return np.stack([p[0] for p in pairs]), np.stack([p[1] for p in pairs])

    def _crop(self, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        film = self.films[rng.choice(len(self.films), p=self.chances)]
        k = int(rng.integers(len(film)))
        _, _, h, w = film.features.shape
        truth = film.truth[k]
        crop = self.crop
        left, top = (int(rng.integers(0, max(edge - crop, 0) + 1)) for edge in (w, h))
        if len(truth) and rng.random() < 0.5:  # around a bacterium, so that sparse films teach too
            x, y = truth[rng.integers(len(truth)), :2]
            left = int(np.clip(x - rng.uniform(0, crop), 0, max(w - crop, 0)))
            top = int(np.clip(y - rng.uniform(0, crop), 0, max(h - crop, 0)))
        part = np.full((film.features.shape[1], crop, crop), NEUTRAL, np.uint8)
        cut = film.features[k, :, top : top + crop, left : left + crop]
        part[:, : cut.shape[1], : cut.shape[2]] = cut
        rows = truth - np.array([left, top, 0, 0], np.float32)
        inside = (rows[:, [X, Y]] > -8).all(axis=1) & (rows[:, [X, Y]] < crop + 8).all(axis=1)
        part, rows = self._augment(part, rows[inside], rng)
        return part, targets(rows, crop, crop, self.stride, self.loss)

    def _augment(self, part: np.ndarray, rows: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        rows = rows.copy()
        last = self.crop - 1
        if rng.random() < 0.5:
            part, rows[:, X] = part[:, :, ::-1], last - rows[:, X]
        if rng.random() < 0.5:
            part, rows[:, Y] = part[:, ::-1], last - rows[:, Y]
        if rng.random() < 0.5:
            part, rows[:, [X, Y]] = part.transpose(0, 2, 1), rows[:, [Y, X]]
        part = np.ascontiguousarray(part)
        if rng.random() < 0.5:  # dark on bright is as good as bright on dark
            part[self.signed] = (2 * NEUTRAL - np.maximum(part[self.signed], 1).astype(np.int16)).astype(np.uint8)
        if rng.random() < 0.3:  # a film with more noise
            noise = rng.normal(0, rng.uniform(1, 8), part[self.signed].shape)
            part[self.signed] = np.clip(part[self.signed] + noise, 0, 255).astype(np.uint8)
        return part, rows
