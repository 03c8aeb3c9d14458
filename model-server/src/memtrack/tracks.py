# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracks as a table: one row a point, whoever made them (a person, the simulator, our tracker or another program)."""

from __future__ import annotations

import enum
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, TypeAlias

import numpy as np
from jaxtyping import Bool, Float64, Int8, Int64
from numpy.typing import ArrayLike

from memtrack.film import Calibration

Column: TypeAlias = ArrayLike | Sequence[Any]
"""What a table can be made of; numpy's own ArrayLike leaves tuples out when it is checked at run time."""

UNLINKED = -1
"""Track id of a detection that belongs to no track."""

UNCALIBRATED = Calibration()


class Motility(enum.IntEnum):
    """How a bacterium moves, by the peak diffusivity of its track (paper section "Determining Track Length")."""

    UNKNOWN = -1
    NONE = 0
    LOW = 1
    MEDIUM = 2
    HIGH = 3

    @staticmethod
    def parse(word: str) -> Motility:
        """The class a file names: a word, or the authors' letter N, L, M or H; UNKNOWN for anything else."""
        word = word.strip().upper()
        short = {"N": "NONE", "L": "LOW", "M": "MEDIUM", "MID": "MEDIUM", "H": "HIGH"}
        return Motility.__members__.get(short.get(word, word), Motility.UNKNOWN)


@dataclass(frozen=True, slots=True)
class TrackTable:
    """Points of tracks, sorted by track and frame; row i of each array describes point i.

    Build one with `TrackTable.of`, which fills in what a source does not say and sorts.

    frames: number of the frame, from 0. ids: number of the track, from 0, or UNLINKED.
    x, y: centre in pixels of the film as the user sees it; the centre of pixel (0, 0) is (0, 0).
    width, height: of the box in pixels, NaN where the source has no boxes.
    scores: in [0, 1] or the source's own quality, NaN where it has none.
    interpolated: the point was predicted or filled in, not seen. ignored: a truth row that is neither right nor
    wrong to find. motility: a value of `Motility` a row. calibration: what the file says of the film.

    Raises:
        ValueError: see `TrackTable.of`.
    """

    frames: Int64[np.ndarray, " n"]
    ids: Int64[np.ndarray, " n"]
    x: Float64[np.ndarray, " n"]
    y: Float64[np.ndarray, " n"]
    width: Float64[np.ndarray, " n"]
    height: Float64[np.ndarray, " n"]
    scores: Float64[np.ndarray, " n"]
    interpolated: Bool[np.ndarray, " n"]
    ignored: Bool[np.ndarray, " n"]
    motility: Int8[np.ndarray, " n"]
    calibration: Calibration = UNCALIBRATED

    def __post_init__(self) -> None:
        n = len(self.frames)
        for name in _COLUMNS:
            if getattr(self, name).shape != (n,):
                raise ValueError(f"{name} has the shape {getattr(self, name).shape}, expected ({n},)")
        if not (np.isfinite(self.x).all() and np.isfinite(self.y).all()):
            raise ValueError("a position is not a finite number")
        if n and self.frames.min() < 0:
            raise ValueError(f"frame {self.frames.min()} is negative; frames are numbered from 0")
        if n and self.ids.min() < UNLINKED:
            raise ValueError(f"track id {self.ids.min()} is below {UNLINKED}")
        same = (self.ids[1:] == self.ids[:-1]) & (self.frames[1:] == self.frames[:-1]) & (self.ids[1:] != UNLINKED)
        if same.any():
            row = int(np.flatnonzero(same)[0])
            raise ValueError(f"track {self.ids[row]} has two points in frame {self.frames[row]}")

    @staticmethod
    def of(
        frames: Column,
        ids: Column,
        x: Column,
        y: Column,
        *,
        width: Column = np.nan,
        height: Column = np.nan,
        scores: Column = np.nan,
        interpolated: Column = False,
        ignored: Column = False,
        motility: Column = Motility.UNKNOWN,
        calibration: Calibration = UNCALIBRATED,
    ) -> TrackTable:
        """A table of these columns (a single value stands for every row), sorted by track, then frame.

        Raises:
            ValueError: columns of unequal length, a position that is not finite, a negative frame, or two points
                of one track in one frame.
        """
        frame_column, id_column = _whole(frames, "frame"), _whole(ids, "track id")
        n = len(frame_column)
        order = np.lexsort((frame_column, np.broadcast_to(id_column, (n,))))

        def column(values: Column, dtype: type) -> np.ndarray:
            return np.broadcast_to(np.asarray(values, dtype), (n,))[order]

        return TrackTable(
            column(frame_column, np.int64),
            column(id_column, np.int64),
            column(x, np.float64),
            column(y, np.float64),
            column(width, np.float64),
            column(height, np.float64),
            column(scores, np.float64),
            column(interpolated, np.bool_),
            column(ignored, np.bool_),
            column(motility, np.int8),
            calibration,
        )

    def __len__(self) -> int:
        return len(self.frames)

    @property
    def frame_count(self) -> int:
        """Number of frames up to the last one that has a point."""
        return int(self.frames.max()) + 1 if len(self) else 0

    @property
    def track_ids(self) -> Int64[np.ndarray, " tracks"]:
        """Ids of the tracks in rising order, UNLINKED not among them."""
        return np.unique(self.ids[self.ids != UNLINKED])

    def select(self, rows: np.ndarray) -> TrackTable:
        """The points at `rows`, a boolean mask or rising indices."""
        return replace(self, **{name: getattr(self, name)[rows] for name in _COLUMNS})

    def tracks(self) -> Iterator[TrackTable]:
        """Each track as a table of its own, by rising id; unlinked detections are left out."""
        first = int(np.searchsorted(self.ids, UNLINKED, side="right"))
        starts = np.flatnonzero(np.diff(self.ids[first:], prepend=UNLINKED)) + first
        for start, stop in zip(starts, np.append(starts, len(self))[1:], strict=True):
            yield self.select(np.arange(start, stop))

    def with_boxes(self, size: float) -> TrackTable:
        """The same points; where a row has no box, a square one of edge `size` in pixels."""
        return replace(
            self,
            width=np.where(np.isnan(self.width), size, self.width),
            height=np.where(np.isnan(self.height), size, self.height),
        )

    @property
    def boxes(self) -> Float64[np.ndarray, "n 4"]:
        """Boxes x_min y_min x_max y_max in pixels, NaN where a row has none (see `with_boxes`)."""
        half_width, half_height = self.width / 2, self.height / 2
        corners = (self.x - half_width, self.y - half_height, self.x + half_width, self.y + half_height)
        return np.stack(corners, axis=1)

    @property
    def lengths(self) -> Int64[np.ndarray, " n"]:
        """For each row, the number of frames its track spans from first to last point; 1 for unlinked detections."""
        _, first, track, count = np.unique(self.ids, return_index=True, return_inverse=True, return_counts=True)
        spans: np.ndarray = (self.frames[first + count - 1] - self.frames[first] + 1)[track]
        spans[self.ids == UNLINKED] = 1
        return spans


def _whole(values: Column, name: str) -> np.ndarray:
    """Values as whole numbers, far from where they would overflow."""
    column = np.asarray(values)
    fits = column.dtype != object and bool((np.abs(column.astype(np.float64)) <= _GREATEST_NUMBER).all())
    if not fits:
        raise ValueError(f"a {name} is not a number from {-_GREATEST_NUMBER} to {_GREATEST_NUMBER}")
    return column.astype(np.int64)


_GREATEST_NUMBER = 2**31 - 1
_COLUMNS = tuple(entry.name for entry in fields(TrackTable) if entry.name != "calibration")
