# SPDX-License-Identifier: GPL-3.0-or-later
"""The Multi-level Object Detector: a net's maps of one frame become candidate boxes with scores and levels.

A level's detector answers where its logit is the highest of the levels'; its score is the probability that a bacterium
of any level is there. So the levels do not share out the score of one that lies between two of them.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float32, Float64, UInt8

from memtrack.boxes import square_boxes
from memtrack.channels import NEUTRAL, Channel
from memtrack.detections import Detections
from memtrack.neighbours import BLOCK, blocks, led_by_the_best

Maps = Float32[np.ndarray, "outputs rows columns"]
Features = UInt8[np.ndarray, "channel height width"] | Sequence[Channel]

ALIGNMENT = 16
MIN_CANDIDATES = 1500
CANDIDATES_PER_PIXEL = MIN_CANDIDATES / (660 * 492)
"""A flood of candidates is cut to the best `MIN_CANDIDATES`, or to this many a pixel where a frame is larger than the
paper's; a bacterium has four or five."""
AGREEING_PX = 3.0


@runtime_checkable
class Engine(Protocol):
    """Runs one model's net on the features of one frame."""

    def run(self, features: UInt8[np.ndarray, "channel height width"]) -> Maps:
        """Output maps of features whose height and width are multiples of `ALIGNMENT`."""
        ...


@dataclass(frozen=True, slots=True)
class Decoder:
    """How maps become boxes; part of a model's card.

    stride: pixels a place of the maps covers. box_size_px: edge of the boxes the model was trained on (paper: 30).
    slope, offset: score = sigmoid(slope * logit + offset), fitted on the validation films to be a probability.
    floor: candidates below this score are not listed at all. distinct_px: candidates nearer than this to a better one
    are of the same bacterium; a long or two-sided one answers at both of its ends.
    """

    stride: int = 4
    box_size_px: float = 30.0
    slope: float = 1.0
    offset: float = 0.0
    floor: float = 0.05
    distinct_px: float = 8.0

    def decode(self, maps: Maps, height: int, width: int) -> Detections:
        """Candidates of one frame of `height` x `width` pixels, several of them on each bacterium.

        A candidate's centre is the mean, weighted by the scores, of those candidates that point to within `AGREEING_PX`
        of it: their errors differ, so the mean is more exact than the best one's. Candidates of one bacterium then get
        the best one's centre, so that the pruner's overlap filter leaves one of them.
        """
        scores = 1 / (1 + np.exp(-(self.slope * maps[0] + self.offset)))
        rows, columns = np.nonzero(scores >= self.floor)
        chosen = scores[rows, columns]
        most = max(MIN_CANDIDATES, round(CANDIDATES_PER_PIXEL * height * width))
        if len(chosen) > most:
            best = np.argpartition(-chosen, most)[:most]
            rows, columns, chosen = rows[best], columns[best], chosen[best]
        places = np.stack([columns, rows], axis=1) + maps[-2:, rows, columns].T
        centres = places * self.stride + (self.stride - 1) / 2
        inside = ((centres >= -0.5) & (centres <= np.array([width, height]) - 0.5)).all(axis=1)
        levels = maps[1:-2, rows, columns].argmax(axis=0)
        centres, chosen, levels = centres[inside], chosen[inside], levels[inside]
        centres = _led(_consensus(centres, chosen), chosen, self.distinct_px)
        boxes = square_boxes(centres, self.box_size_px).astype(np.float32)
        return Detections(boxes, chosen.astype(np.float32), levels.astype(np.int8))


def _consensus(centres: Float64[np.ndarray, "n 2"], scores: Float32[np.ndarray, " n"]) -> Float64[np.ndarray, "n 2"]:
    means = np.empty_like(centres)
    for rows, near in blocks(centres[:, 1], AGREEING_PX, BLOCK):
        weights = scores[near] * (_squared_distances(centres[rows], centres[near]) <= AGREEING_PX**2)
        means[rows] = weights @ centres[near] / weights.sum(axis=1, keepdims=True)
    return means


def _led(
    centres: Float64[np.ndarray, "n 2"], scores: Float32[np.ndarray, " n"], distinct_px: float
) -> Float64[np.ndarray, "n 2"]:
    """Each centre moved onto that of the best scored candidate nearer than `distinct_px`, best ones first."""

    def near(rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        return _squared_distances(centres[rows], centres[columns]) < distinct_px**2

    out = centres.copy()
    for i, followers in led_by_the_best(scores, centres[:, 1], distinct_px, near):
        out[followers] = centres[i]
    return out


def _squared_distances(
    first: Float64[np.ndarray, "n 2"], second: Float64[np.ndarray, "m 2"]
) -> Float64[np.ndarray, "n m"]:
    # One axis at a time: many times as fast as a sum over an axis of two.
    squares, y = (second[None, :, axis] - first[:, None, axis] for axis in (0, 1))
    squares *= squares
    y *= y
    squares += y
    return squares


class _Room(threading.local):
    """Where a thread brings channels together: new room for each frame would take longer than filling it."""

    size = (0, 0, 0)
    array = np.empty(0, np.uint8)


_room = _Room()


def padded(channels: Features) -> UInt8[np.ndarray, "channel y x"]:
    """Channels of one size with neutral rows and columns added below and to the right, up to multiples of `ALIGNMENT`.

    The array is the thread's own, until it calls this again.
    """
    h, w = channels[0].shape
    if _room.size != (len(channels), h, w):
        shape = len(channels), -h % ALIGNMENT + h, -w % ALIGNMENT + w
        _room.size, _room.array = (len(channels), h, w), np.full(shape, NEUTRAL, np.uint8)
    for number, channel in enumerate(channels):
        _room.array[number, :h, :w] = channel
    return _room.array


def detect(engine: Engine, decoder: Decoder, channels: Features) -> Detections:
    """Candidates of one frame; no filter but the decoder's floor has been applied."""
    return decoder.decode(engine.run(padded(channels)), *channels[0].shape)
