# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from memtrack.config import CHUNK_BYTES
from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.receiving import FrameReceiver
from memtrack.spool import FilmGeometry, SpooledFilm
from memtrack.v1 import detection_pb2 as pb


@pytest.fixture
def receiver(tmp_path: Path) -> Iterator[FrameReceiver]:
    """Takes three frames of 4 x 2 samples of 16 bit, 16 bytes each."""
    with SpooledFilm(FilmGeometry(4, 2, 3, np.dtype("<u2")), Calibration(), tmp_path) as film:
        yield FrameReceiver(film)


def take(receiver: FrameReceiver, *chunks: tuple[int, int]) -> None:
    for frame, size in chunks:
        receiver.take(pb.FrameChunk(frame=frame, data=bytes([frame + 1]) * size))


def test_frames_in_one_or_more_chunks_add_up(receiver: FrameReceiver) -> None:
    take(receiver, (0, 16), (1, 1), (1, 15), (2, 8))
    assert receiver.frames == 2
    take(receiver, (2, 8))
    expected = b"\1" * 16 + b"\2" * 16 + b"\3" * 16
    assert receiver.finish() == hashlib.sha256(expected).hexdigest()


@pytest.mark.parametrize(
    ("chunks", "sentence"),
    [
        ([(1, 16)], "frame 1 came while frame 0 was due; a frame is missing"),
        ([(0, 16), (2, 16)], "frame 2 came while frame 1 was due; a frame is missing"),
        ([(-1, 16)], "frame -1 came again while frame 0 was due"),
        ([(0, 16), (0, 16)], "frame 0 came again while frame 1 was due"),
        ([(0, 10), (1, 16)], r"frame 0 has 10 bytes, expected 16 \(4 x 2 samples of 2 byte\(s\)\)"),
        ([(0, 17)], r"frame 0 has at least 17 bytes, expected 16"),
        ([(0, 10), (0, 7)], r"frame 0 has at least 17 bytes, expected 16"),
        ([(0, 0)], "an empty chunk came for frame 0"),
        ([(0, CHUNK_BYTES + 1)], f"a chunk of frame 0 has {CHUNK_BYTES + 1} bytes, at most {CHUNK_BYTES} are allowed"),
        ([(0, 16), (1, 16), (2, 16), (3, 16)], r"more samples came after the last of 3 frames \(frame 3, 16 bytes\)"),
        ([(0, 16), (1, 16), (2, 16), (2, 1)], r"more samples came after the last of 3 frames \(frame 2, 1 bytes\)"),
    ],
)
def test_chunks_that_do_not_add_up_are_refused(
    receiver: FrameReceiver, chunks: list[tuple[int, int]], sentence: str
) -> None:
    with pytest.raises(FilmError, match=f"^{sentence}"):
        take(receiver, *chunks)


def test_a_film_that_ends_early_is_refused(receiver: FrameReceiver) -> None:
    with pytest.raises(FilmError, match=r"^the film ended after 0 of 3 frames$"):
        receiver.finish()
    take(receiver, (0, 16), (1, 5))
    with pytest.raises(FilmError, match=r"^the film ended after 1 of 3 frames and 5 of 16 bytes of the next$"):
        receiver.finish()
