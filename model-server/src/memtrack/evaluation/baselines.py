# SPDX-License-Identifier: GPL-3.0-or-later
"""What anyone can run instead: spot detectors without learning, each with its settings tuned on the very answer.

| name | what |
|---|---|
| log | maxima of the Laplacian of a Gaussian on the frame (the detector TrackMate starts with) |
| log-deviation | the same on the frame minus the film's median, what a skilled Fiji user does first |
| trackpy | trackpy's locate (Crocker and Grier 1996) on the frame minus the median; needs the extra `baselines` |

The radius, the sign (bright spots, dark ones or both) and the threshold that give the greatest F1 on the truth are
taken, so a baseline is shown at its best; nothing of ours is tuned that way.
"""

from __future__ import annotations

import importlib
import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from jaxtyping import Float32

from memtrack.detections import Detections, FrameDetections, Level
from memtrack.errors import EngineUnavailableError
from memtrack.evaluation.curves import CurvePoint, best_f1, precision_recall_curve
from memtrack.evaluation.matching import Counts, Criterion
from memtrack.evaluation.stages import as_table
from memtrack.film import Film
from memtrack.tracks import TrackTable

NAMES = ("log", "log-deviation", "trackpy")
SIGNS = {"bright": (1.0,), "dark": (-1.0,), "both": (1.0, -1.0)}
RADII_PX = (2.5, 4.0, 6.0, 9.0)
MOST_SPOTS = 200
"""Strongest spots kept in a frame; far more than any film of ours has cells."""

MEDIAN_FRAMES = 100

LEAST_RESPONSE = 1e-3
"""Grey levels; what is below is rounding on a flat image."""

Image = Float32[np.ndarray, "height width"]


@dataclass(frozen=True, slots=True)
class TunedBaseline:
    """A baseline at its best on the truth of the films: its settings, and what it then finds."""

    name: str
    radius_px: float
    sign: str
    threshold: float
    counts: Counts


def tune(name: str, films: Sequence[tuple[Film, TrackTable]], criterion: Criterion) -> TunedBaseline:
    """The settings of one baseline with the greatest F1 over all films.

    Raises:
        EngineUnavailableError: trackpy is asked for and not installed.
    """
    results: list[tuple[CurvePoint, float, str]] = []
    for radius in RADII_PX:
        for sign in SIGNS:
            spots = (detect(name, film, radius, sign, criterion.box_size_px) for film, _ in films)
            pairs = [(truth, as_table(found)) for (_, truth), found in zip(films, spots, strict=True)]
            curve = precision_recall_curve(pairs, criterion)
            if curve:
                results.append((best_f1(curve), radius, sign))
    if not results:
        nothing = sum((Counts(0, 0, int((~truth.ignored).sum())) for _, truth in films), Counts())
        return TunedBaseline(name, RADII_PX[0], "bright", 0.0, nothing)
    best, radius, sign = max(results, key=lambda result: np.nan_to_num(result[0].counts.f1))
    return TunedBaseline(name, radius, sign, best.threshold, best.counts)


def detect(name: str, film: Film, radius_px: float, sign: str, box_size_px: float = 30.0) -> list[FrameDetections]:
    """Every spot a baseline sees in a film, scored by its own strength (not a probability), in square boxes.

    `sign` is one of SIGNS. `radius_px` is that of the spots, as in TrackMate.

    Raises:
        EngineUnavailableError: trackpy is asked for and not installed.
    """
    spots = _trackpy_spots() if name == "trackpy" else _log_spots
    found = []
    for index, image in enumerate(_images(film, subtract=name != "log")):
        seen = [spots(factor * image, radius_px) for factor in SIGNS[sign]]
        x, y, strength = (np.concatenate(column) for column in zip(*seen, strict=True))
        order = np.argsort(-strength, kind="stable")[:MOST_SPOTS]
        half = box_size_px / 2
        boxes = np.stack([x - half, y - half, x + half, y + half], axis=1)[order].astype(np.float32)
        levels = np.full(len(order), Level.HIGH, np.int8)
        found.append(FrameDetections(index, Detections(boxes, strength[order].astype(np.float32), levels)))
    return found


def _images(film: Film, subtract: bool) -> Iterator[Image]:
    """The frames in grey levels, less the film's median if asked for."""
    unit = _unit(film)
    median: Image | float = 0.0
    if subtract:
        chosen = np.unique(np.linspace(0, film.frame_count - 1, MEDIAN_FRAMES).astype(int))
        median = np.median([film.frame(int(i)) for i in chosen], axis=0).astype(np.float32)
    for index in range(film.frame_count):
        yield (film.frame(index).astype(np.float32) - median) / unit


def _unit(film: Film) -> float:
    """What a grey level is in the film's numbers: 1, or of floating point numbers, whose unit nobody knows, a share of
    their range as in a film of 8 bits."""
    if film.frame(0).dtype.kind != "f":
        return 1.0
    extremes = [(frame.min(), frame.max()) for frame in map(film.frame, range(film.frame_count))]
    low, high = np.array(extremes, np.float64).T
    return float(high.max() - low.min()) / 255 or 1.0


Spots = tuple[np.ndarray, np.ndarray, np.ndarray]


def _log_spots(image: Image, radius_px: float) -> Spots:
    """Maxima of the scale-normalised negative Laplacian of a Gaussian with sigma = radius / sqrt(2), sub-pixel."""
    sigma = radius_px / math.sqrt(2)
    smooth = cv2.GaussianBlur(image, (0, 0), sigma, borderType=cv2.BORDER_REFLECT_101)
    response = -(sigma**2) * cv2.Laplacian(smooth, cv2.CV_32F, borderType=cv2.BORDER_REFLECT_101)
    size = 2 * int(np.ceil(radius_px)) + 1
    highest = cv2.dilate(response, np.ones((size, size), np.uint8))
    inside = np.s_[1:-1, 1:-1]
    y, x = np.nonzero((response == highest)[inside] & (response[inside] > LEAST_RESPONSE))
    y, x = y + 1, x + 1
    return x + _offset(response, y, x, 0, 1), y + _offset(response, y, x, 1, 0), response[y, x]


def _offset(response: Image, y: np.ndarray, x: np.ndarray, dy: int, dx: int) -> np.ndarray:
    """Where the parabola through a maximum and its two neighbours has its top, within half a pixel."""
    before, here, after = response[y - dy, x - dx], response[y, x], response[y + dy, x + dx]
    bend = 2 * here - before - after
    top = np.divide(after - before, 2 * bend, out=np.zeros_like(here), where=bend > 0)
    return np.clip(top, -0.5, 0.5)


def _trackpy_spots() -> Callable[[Image, float], Spots]:
    try:
        trackpy: Any = importlib.import_module("trackpy")
    except ImportError as error:
        raise EngineUnavailableError("trackpy is not installed; install memtrack with the extra 'baselines'") from error
    trackpy.quiet()

    def spots(image: Image, radius_px: float) -> Spots:
        diameter = 2 * round(radius_px) + 1
        grey = np.clip(image - image.min(), 0, 65535).astype(np.uint16)
        with warnings.catch_warnings():  # trackpy 0.7 calls what pandas 3 deprecates, and tells of frames without spots
            warnings.simplefilter("ignore")
            table = trackpy.locate(grey, diameter, topn=MOST_SPOTS, characterize=False)
        return table["x"].to_numpy(), table["y"].to_numpy(), table["mass"].to_numpy()

    return spots
