# SPDX-License-Identifier: GPL-3.0-or-later
"""Batches of crops with random flips, contrast inversion, gain and noise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float32, Int, UInt8

from memtrack.channels import NEUTRAL
from memtrack.motion import FeatureSpec
from memtrack.training.loss import LossSettings, targets
from memtrack.training.samples import FilmSamples, X, Y


class Batches:
    """Draws crops: a film, harder ones more often, a frame, and a place, more often one that holds a bacterium."""

    def __init__(
        self,
        films: Sequence[FilmSamples],
        spec: FeatureSpec,
        *,
        crop: int,
        size: int,
        stride: int,
        loss: LossSettings,
    ) -> None:
        self.films, self.crop, self.size, self.stride, self.loss = films, crop, size, stride, loss
        self.signed = signed_channels(spec)
        self.difficulty = np.ones(len(films))
        # One long row of noise, of which crops take pieces: drawing it anew took a quarter of a training's time.
        pixels = int(self.signed.sum()) * crop * crop
        self._noise = np.random.default_rng(0).standard_normal(3 * pixels, np.float32)

    def draw(
        self, rng: np.random.Generator
    ) -> tuple[UInt8[np.ndarray, "n channel crop crop"], Float32[np.ndarray, "n 5 y x"], Int[np.ndarray, " n"]]:
        """The next batch: features, target maps, and which film each crop is from."""
        chances = np.clip(self.difficulty / self.difficulty.mean(), 0.4, 3.0)
        chosen = rng.choice(len(self.films), self.size, p=chances / chances.sum())
        pairs = [self._crop(self.films[k], rng) for k in chosen]
        return np.stack([p[0] for p in pairs]), np.stack([p[1] for p in pairs]), chosen

    def learned(self, chosen: Int[np.ndarray, " n"], losses: Float32[np.ndarray, " n"]) -> None:
        """Takes in how hard the crops of a batch were: films the net fails on, empty ones too, come more often."""
        for k, loss in zip(chosen, losses, strict=True):
            self.difficulty[k] = 0.8 * self.difficulty[k] + 0.2 * float(loss)

    def _crop(self, film: FilmSamples, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
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
            part[self.signed] = inverted(part[self.signed])
        if rng.random() < 0.3 and self.signed.any():  # a film with more noise
            signed = part[self.signed]
            first = int(rng.integers(len(self._noise) - signed.size))
            noise = self._noise[first : first + signed.size].reshape(signed.shape) * np.float32(rng.uniform(1, 8))
            part[self.signed] = np.clip(signed + noise, 0, 255).astype(np.uint8)
        return part, rows


def signed_channels(spec: FeatureSpec) -> Bool[np.ndarray, " channel"]:
    """Which channels say whether something is brighter or darker."""
    return np.array([c == "grey" or c.startswith("deviation") for c in spec.channels])


def inverted(values: UInt8[np.ndarray, "..."]) -> UInt8[np.ndarray, "..."]:
    """Bright for dark in signed channels: 256 - v, in 8 bits."""
    return np.uint8(0) - np.maximum(values, 1)
