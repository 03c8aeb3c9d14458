# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import threading

import pytest

from memtrack.turns import Turns


def test_turns_come_in_the_order_of_asking_and_never_together() -> None:
    turns = Turns()
    done: list[int] = []
    heard: list[list[int]] = [[] for _ in range(5)]
    at_work = threading.Lock()

    def work(i: int, asked: threading.Event) -> None:
        def waiting(ahead: int) -> None:
            heard[i].append(ahead)
            asked.set()

        with turns.turn(waiting, interval_seconds=0.01):
            assert at_work.acquire(blocking=False)
            done.append(i)
            at_work.release()

    threads = []
    with turns.turn(lambda ahead: pytest.fail(f"{ahead} before the first")):
        for i in range(5):
            asked = threading.Event()
            threads.append(threading.Thread(target=work, args=(i, asked)))
            threads[-1].start()
            assert asked.wait(10)
    for thread in threads:
        thread.join(10)
    assert done == [0, 1, 2, 3, 4]
    for i, ahead in enumerate(heard):
        assert ahead[0] == i + 1
        assert ahead == sorted(ahead, reverse=True)


def test_one_that_gives_up_waiting_does_not_hold_up_the_others() -> None:
    turns = Turns()

    def give_up(ahead: int) -> None:
        raise KeyError(ahead)

    with turns.turn(lambda _: None), pytest.raises(KeyError, match="1"), turns.turn(give_up, interval_seconds=0.01):
        pytest.fail("two at once")
    with turns.turn(lambda ahead: pytest.fail(f"{ahead} left in the queue")):
        pass


def test_a_failure_within_a_turn_ends_it() -> None:
    turns = Turns()
    with pytest.raises(KeyError), turns.turn(lambda _: None):
        raise KeyError
    with turns.turn(lambda ahead: pytest.fail(f"{ahead} left in the queue")):
        pass
