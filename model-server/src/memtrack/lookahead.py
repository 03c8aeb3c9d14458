# SPDX-License-Identifier: GPL-3.0-or-later
"""Work on the frames of a film in threads, a few frames ahead of where its results are used."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")


@contextmanager
def ahead(work: Callable[[T], R], items: Iterator[T], threads: int) -> Iterator[Iterator[R]]:
    """`map(work, items)` with `work` done in `threads` threads, while the caller makes the items and uses the results.

    Only the caller reads a film, and no more than `threads` + 1 items wait. What is not done when the context ends is
    dropped.
    """
    with ThreadPoolExecutor(threads, "ahead") as pool:
        results = _in_order(pool, work, items, threads + 1)
        try:
            yield results
        finally:
            results.close()


def _in_order(pool: ThreadPoolExecutor, work: Callable[[T], R], items: Iterator[T], depth: int) -> Generator[R]:
    waiting: deque[Future[R]] = deque()
    try:
        for item in items:
            waiting.append(pool.submit(work, item))
            if len(waiting) >= depth:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        for future in waiting:
            future.cancel()
