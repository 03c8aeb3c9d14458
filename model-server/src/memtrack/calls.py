# SPDX-License-Identifier: GPL-3.0-or-later
"""One call of DetectFilm: what its film's thread says, on the way to the client, and the client's wish to stop."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Iterator

from memtrack.errors import CancelledError, IdleError
from memtrack.v1 import detection_pb2 as pb

_POLL_SECONDS = 0.5


class FilmCall:
    """Messages from the thread that works on a film to the thread that answers the client.

    The worker calls `send`, `finish`, `fail` and `check`; the answering thread `responses`; anybody `cancel`.
    """

    def __init__(self, idle_seconds: float) -> None:
        self._messages: queue.SimpleQueue[pb.DetectFilmResponse | BaseException | None] = queue.SimpleQueue()
        self._ended = threading.Event()
        self._idle_seconds = idle_seconds
        self._heard: float | None = time.monotonic()

    def heard(self) -> None:
        """The client has sent something."""
        self._heard = time.monotonic()

    def received(self) -> None:
        """The client has sent everything; from here on its silence means nothing."""
        self._heard = None

    def check(self) -> None:
        """Raises CancelledError when nobody wants the result any more."""
        if self._ended.is_set():
            raise CancelledError("the film was cancelled")

    def send(self, response: pb.DetectFilmResponse) -> None:
        """Queues a message; raises CancelledError as `check` does. Messages are small: a film's fit in memory."""
        self.check()
        self._messages.put(response)

    def finish(self, last: pb.DetectFilmResponse) -> None:
        """Queues the last message."""
        self._messages.put(last)
        self._messages.put(None)

    def fail(self, error: BaseException) -> None:
        """Ends the call with `error`; the first end counts."""
        if not self._ended.is_set():
            self._ended.set()
            self._messages.put(error)

    def cancel(self) -> None:
        """The client has cancelled, or is gone."""
        self.fail(CancelledError("the film was cancelled"))

    def responses(self) -> Iterator[pb.DetectFilmResponse]:
        """The messages in order, until the worker has finished.

        Raises:
            IdleError: the client sent nothing for too long.
            BaseException: what the worker failed with.
        """
        while True:
            try:
                message = self._messages.get(timeout=_POLL_SECONDS)
            except queue.Empty:
                self._check_idle()
                continue
            if message is None:
                return
            if isinstance(message, BaseException):
                raise message
            yield message

    def _check_idle(self) -> None:
        heard = self._heard
        if heard is not None and time.monotonic() - heard > self._idle_seconds:
            self.fail(IdleError(f"no frame came for {self._idle_seconds:g} s, so the film was given up; run it again"))
