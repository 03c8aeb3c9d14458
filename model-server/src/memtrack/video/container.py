# SPDX-License-Identifier: GPL-3.0-or-later
"""Films in AVI and other video files."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import cv2

from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.spool import FilmGeometry, SpooledFilm, default_folder
from memtrack.video.source import Frame, Source, grey, notes_on, red_first


@contextlib.contextmanager
def open_container(path: Path) -> Iterator[Source]:
    """The film in a video file, decoded once from front to back into a spool: seeking in such files misses frames.

    Raises:
        FilmError: it cannot be decoded, or holds far fewer frames than it should.
    """
    with contextlib.closing(_Decoder(path)) as decoder:
        first = next(decoder, None)
        if first is None:
            raise FilmError(f"{path.name} cannot be decoded as video; save the film as TIFF")
        height, width = first.shape
        geometry = FilmGeometry(width, height, 1, first.dtype)
        with SpooledFilm(geometry, decoder.calibration, default_folder()) as film:
            film.append(first.tobytes())
            for frame in decoder:
                if frame.shape != first.shape:
                    raise FilmError(f"frame {film.frame_count + 1} of {path.name} has another size than frame 1")
                film.append(frame.tobytes())
                film.geometry = replace(film.geometry, frame_count=film.frame_count + 1)
            notes = decoder.notes + _missing(path, film.frame_count, decoder.promised)
            yield Source(film.frame_count, height, width, film.frame, decoder.calibration, notes)


def _missing(path: Path, held: int, promised: int) -> tuple[str, ...]:
    """A note where a file holds fewer frames than its header says; other containers than AVI only estimate them.

    Raises:
        FilmError: an AVI lacks so many that it broke off when it was written or copied, not a few that a camera lost.
    """
    if held >= promised:
        return ()
    if path.suffix.lower() == ".avi" and held < 0.9 * promised:
        raise FilmError(f"{path.name} holds {held} of {promised} frames, the rest is lost; copy or record it again")
    return (f"{path.name} holds {held} frames, its header says {promised}.",)


class _Decoder:
    """Frames of a video file, one after the other."""

    def __init__(self, path: Path) -> None:
        self._capture = cv2.VideoCapture(str(path))
        rate = self._capture.get(cv2.CAP_PROP_FPS)
        self.calibration = Calibration(None, 1 / rate if rate > 0 else None)
        self.promised = max(0, int(self._capture.get(cv2.CAP_PROP_FRAME_COUNT)))
        self.notes: tuple[str, ...] = ()

    def __iter__(self) -> _Decoder:
        return self

    def __next__(self) -> Frame:
        decoded, image = self._capture.read()
        if not decoded:
            raise StopIteration
        image = red_first(image)
        self.notes = self.notes or notes_on(image)
        return grey(image)

    def close(self) -> None:
        self._capture.release()
