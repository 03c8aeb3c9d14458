# SPDX-License-Identifier: GPL-3.0-or-later
"""One film at work at a time, in the order in which they were ready: two would only slow each other down."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Iterator


class Turns:
    """A fair lock whose waiters hear how many are before them."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._queue: list[object] = []

    @contextlib.contextmanager
    def turn(self, waiting: Callable[[int], None], *, interval_seconds: float = 0.5) -> Iterator[None]:
        """Waits until all earlier ones have left the block; `waiting(ahead)` is called meanwhile and may raise."""
        ticket = object()
        with self._changed:
            self._queue.append(ticket)
        try:
            while ahead := self._ahead(ticket):
                waiting(ahead)
                self._wait(ticket, interval_seconds)
            yield
        finally:
            with self._changed:
                self._queue.remove(ticket)
                self._changed.notify_all()

    def _ahead(self, ticket: object) -> int:
        with self._changed:
            return self._queue.index(ticket)

    def _wait(self, ticket: object, seconds: float) -> None:
        with self._changed:
            if self._queue[0] is not ticket:
                self._changed.wait(seconds)
