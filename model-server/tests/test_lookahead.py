# SPDX-License-Identifier: GPL-3.0-or-later
import threading
from collections.abc import Iterator

import pytest

from memtrack.lookahead import ahead


@pytest.mark.parametrize("threads", [1, 3])
def test_results_come_in_order_and_the_caller_alone_makes_the_items(threads: int) -> None:
    makers, workers = set(), set()

    def items() -> Iterator[int]:
        for i in range(20):
            makers.add(threading.get_ident())
            yield i

    def work(i: int) -> int:
        workers.add(threading.get_ident())
        return i * i

    with ahead(work, items(), threads) as results:
        assert list(results) == [i * i for i in range(20)]
    assert makers == {threading.get_ident()}
    assert threading.get_ident() not in workers
    assert len(workers) <= threads


def test_no_more_items_are_made_than_wait_and_the_rest_is_dropped() -> None:
    made = []

    def items() -> Iterator[int]:
        for i in range(100):
            made.append(i)
            yield i

    with ahead(lambda i: i, items(), 2) as results:
        assert next(results) == 0
        assert len(made) == 3
    assert len(made) == 3
    assert not any(thread.name.startswith("ahead") for thread in threading.enumerate())


def test_an_error_reaches_the_caller_at_its_place() -> None:
    def work(i: int) -> float:
        return 1 / (i - 2)

    with ahead(work, iter(range(5)), 2) as results:
        assert [next(results), next(results)] == [-0.5, -1.0]
        with pytest.raises(ZeroDivisionError):
            next(results)
