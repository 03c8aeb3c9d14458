# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames as they come from a client: checked for order and size, spooled, and hashed."""

from __future__ import annotations

import hashlib

from memtrack.config import CHUNK_BYTES
from memtrack.errors import FilmError
from memtrack.spool import SpooledFilm
from memtrack.v1 import detection_pb2 as pb


class FrameReceiver:
    """Puts the chunks of one film together; each `take` may raise FilmError with what is wrong about the chunk."""

    def __init__(self, film: SpooledFilm) -> None:
        self._film = film
        self._geometry = film.geometry
        self._hash = hashlib.sha256()
        self._bytes = 0
        self.frames = 0
        """Frames received whole."""

    def take(self, chunk: pb.FrameChunk) -> None:
        """Adds `chunk` to the film."""
        self._check(chunk.frame, len(chunk.data))
        self._film.append(chunk.data)
        self._hash.update(chunk.data)
        self._bytes += len(chunk.data)
        if self._bytes == self._geometry.frame_bytes:
            self.frames, self._bytes = self.frames + 1, 0

    def finish(self) -> str:
        """The SHA-256 of all samples, once the client has closed its side.

        Raises:
            FilmError: frames are missing.
        """
        if self.frames < self._geometry.frame_count:
            part = f" and {self._bytes} of {self._geometry.frame_bytes} bytes of the next" if self._bytes else ""
            raise FilmError(f"the film ended after {self.frames} of {self._geometry.frame_count} frames{part}")
        return self._hash.hexdigest()

    def _check(self, frame: int, size: int) -> None:
        g = self._geometry
        if self.frames == g.frame_count:
            raise FilmError(f"more samples came after the last of {g.frame_count} frames (frame {frame}, {size} bytes)")
        if frame != self.frames:
            if frame > self.frames and self._bytes:
                raise FilmError(
                    f"frame {self.frames} has {self._bytes} bytes, expected {g.frame_bytes} ({_size(self._film)})"
                )
            if frame > self.frames:
                raise FilmError(f"frame {frame} came while frame {self.frames} was due; a frame is missing")
            raise FilmError(f"frame {frame} came again while frame {self.frames} was due")
        if size == 0:
            raise FilmError(f"an empty chunk came for frame {frame}")
        if size > CHUNK_BYTES:
            raise FilmError(f"a chunk of frame {frame} has {size} bytes, at most {CHUNK_BYTES} are allowed")
        if self._bytes + size > g.frame_bytes:
            raise FilmError(
                f"frame {frame} has at least {self._bytes + size} bytes, expected {g.frame_bytes} ({_size(self._film)})"
            )


def _size(film: SpooledFilm) -> str:
    return f"{film.width} x {film.height} samples of {film.geometry.dtype.itemsize} byte(s)"
