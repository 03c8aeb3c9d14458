# SPDX-License-Identifier: GPL-3.0-or-later
"""Films on disk while they are worked on, so that memory does not grow with their length.

A spool is a temporary file that the system itself deletes when it is closed or its process dies: without a name on
Linux and macOS, delete-on-close on Windows. A power cut on Windows, or a network disk, can leave one behind:
`sweep` takes it away at the next start.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

import numpy as np
from jaxtyping import Shaped

from memtrack.errors import ResourceLimitError
from memtrack.film import Calibration

PREFIX = "memtrack-spool-"
MARGIN_BYTES = 256 << 20
"""Disk space that is left to others."""
_SWEEP_AGE_SECONDS = 60


def default_folder() -> Path:
    """Where films are spooled unless told otherwise: the user's choice of a temporary folder, or else one on a disk.

    On many Linux systems /tmp is memory; /var/tmp is not.
    """
    chosen = any(os.environ.get(name) for name in ("TMPDIR", "TEMP", "TMP"))
    lasting = Path("/var/tmp")
    return lasting if not chosen and os.access(lasting, os.W_OK) else Path(tempfile.gettempdir())


@dataclass(frozen=True, slots=True)
class FilmGeometry:
    """Size and sample type of a film; sizes in pixels, `dtype` is uint8, uint16 or float32, little-endian."""

    width: int
    height: int
    frame_count: int
    dtype: np.dtype[np.generic]

    @property
    def pixels(self) -> int:
        """Pixels of all frames together."""
        return self.width * self.height * self.frame_count

    @property
    def frame_bytes(self) -> int:
        return self.width * self.height * self.dtype.itemsize

    @property
    def film_bytes(self) -> int:
        return self.frame_bytes * self.frame_count


class SpooledFilm:
    """A film in a temporary file: append its bytes once, then read frames in any order, from any thread.

    Reads go through a buffer of one frame rather than a memory map, whose pages would count as the process's memory.
    """

    def __init__(self, geometry: FilmGeometry, calibration: Calibration, folder: Path) -> None:
        self.geometry = geometry
        self._calibration = calibration
        self._lock = threading.Lock()
        self._written = 0
        try:
            self._file = tempfile.TemporaryFile(prefix=PREFIX, suffix=".raw", dir=folder, buffering=0)  # noqa: SIM115
        except OSError as error:
            raise ResourceLimitError(f"cannot spool the film in {folder}: {error.strerror or error}") from error

    def __enter__(self) -> SpooledFilm:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Gives the disk space back; frames can no longer be read."""
        with self._lock:
            self._file.close()

    @property
    def missing_bytes(self) -> int:
        """Bytes that are still to come."""
        return self.geometry.film_bytes - self._written

    def append(self, samples: bytes) -> None:
        """Adds samples after those that are there.

        Raises:
            ResourceLimitError: the disk is full.
        """
        view = memoryview(samples)
        try:
            with self._lock:
                self._file.seek(self._written)
                while view:
                    count = self._file.write(view)
                    self._written += count
                    view = view[count:]
        except OSError as error:
            raise ResourceLimitError(
                f"the film could not be spooled after {self._written} of {self.geometry.film_bytes} bytes "
                f"({error.strerror or error}); free some disk space, or give the server another --spool-folder"
            ) from error

    @property
    def frame_count(self) -> int:
        return self.geometry.frame_count

    @property
    def height(self) -> int:
        return self.geometry.height

    @property
    def width(self) -> int:
        return self.geometry.width

    @property
    def calibration(self) -> Calibration:
        return self._calibration

    def frame(self, index: int) -> Shaped[np.ndarray, "height width"]:
        """Frame `index`, from 0; it must have been appended whole."""
        size = self.geometry.frame_bytes
        if not 0 <= index < self.frame_count or (index + 1) * size > self._written:
            raise IndexError(f"frame {index} of {self.frame_count} is not in the spool")
        frame = np.empty((self.height, self.width), self.geometry.dtype)
        view = frame.reshape(-1).view(np.uint8).data
        with self._lock:
            self._file.seek(index * size)
            while view:
                count = self._file.readinto(view)
                if not count:
                    raise OSError(f"the spool ended within frame {index}")
                view = view[count:]
        return frame


class SpoolFolder:
    """The folder where spools lie; keeps films that are received at the same time from filling the disk together."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        self._open: list[SpooledFilm] = []

    def free_bytes(self) -> int:
        """Space a further film may take: what the disk has, less a margin and what open films still need."""
        with self._lock:
            return self._free_bytes()

    def _free_bytes(self) -> int:
        promised = sum(film.missing_bytes for film in self._open)
        return max(0, shutil.disk_usage(self.folder).free - promised - MARGIN_BYTES)

    @contextlib.contextmanager
    def open(self, geometry: FilmGeometry, calibration: Calibration) -> Iterator[SpooledFilm]:
        """An empty spool for one film, gone at the end of the block.

        Raises:
            ResourceLimitError: the film would not fit on the disk.
        """
        with self._lock:
            free = self._free_bytes()
            if geometry.film_bytes > free:
                raise ResourceLimitError(
                    f"the film needs {megabytes(geometry.film_bytes)} of disk, but {self.folder} has {megabytes(free)} "
                    "to spare; free some space, or give the server another --spool-folder"
                )
            film = SpooledFilm(geometry, calibration, self.folder)
            self._open.append(film)
        try:
            yield film
        finally:
            film.close()
            with self._lock:
                self._open.remove(film)


def sweep(folder: Path) -> int:
    """Deletes spools that dead servers left in `folder`; returns how many.

    A spool of a living server has no name (Linux, macOS) or survives its deletion until it is closed (Windows).
    """
    swept = 0
    for file in folder.glob(f"{PREFIX}*.raw"):
        with contextlib.suppress(OSError):
            if time.time() - file.stat().st_mtime > _SWEEP_AGE_SECONDS:
                file.unlink()
                swept += 1
    return swept


def megabytes(count: int) -> str:
    """A number of bytes for people."""
    return f"{count / 1e9:.1f} GB" if count >= 1e9 else f"{count / 1e6:.1f} MB"
