# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memtrack.progress import ProgressClock, Stage, StageCosts

COSTS = {Stage.RECEIVING: 1.0, Stage.STABILISING: 2.0, Stage.BACKGROUND: 3.0, Stage.DETECTING: 4.0}


class Time:
    """A clock that stands still until it is moved."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def test_each_stage_has_its_share_of_the_whole() -> None:
    progress = ProgressClock(10, COSTS, clock=Time())
    fractions = [progress.advance(stage, done, 4).fraction for stage in Stage for done in (2, 4)]
    assert fractions == pytest.approx([0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0])


def test_steps_of_a_stage_are_told_as_frames_of_the_film() -> None:
    standing = ProgressClock(10, COSTS, clock=Time()).advance(Stage.STABILISING, 30, 40)
    assert (standing.stage, standing.frames_done, standing.frames_total) == (Stage.STABILISING, 7, 10)


def test_the_time_left_is_exact_when_every_stage_keeps_to_its_cost() -> None:
    time = Time()
    progress = ProgressClock(100, COSTS, clock=time)
    begun = time.now
    for stage in Stage:
        for frame in range(100):
            time.now += COSTS[stage] / 100 * 30
            standing = progress.advance(stage, frame + 1, 100)
            if standing.seconds_left is not None:
                assert standing.seconds_left == pytest.approx(begun + 300 - time.now, abs=1e-6)
    assert standing.seconds_left == 0
    assert progress.seconds == pytest.approx({stage: 30 * cost for stage, cost in COSTS.items()})


def test_no_time_left_is_told_on_the_first_breath() -> None:
    time = Time()
    progress = ProgressClock(1000, COSTS, clock=time)
    time.now += 0.1
    assert progress.advance(Stage.RECEIVING, 500, 1000).seconds_left is None
    time.now += 1
    assert progress.advance(Stage.RECEIVING, 501, 1000).seconds_left is not None


def test_a_wait_is_nobodys_time() -> None:
    time = Time()
    progress = ProgressClock(10, COSTS, clock=time)
    time.now += 1
    progress.advance(Stage.RECEIVING, 10, 10)
    time.now += 1000
    progress.restart()
    time.now += 2
    progress.advance(Stage.STABILISING, 10, 10)
    assert progress.seconds == {Stage.RECEIVING: 1, Stage.STABILISING: 2}


@given(st.lists(st.tuples(st.sampled_from(Stage), st.integers(0, 60), st.integers(1, 50)), max_size=30))
def test_whatever_is_reported_the_fraction_never_falls_nor_leaves_its_bounds(
    reports: list[tuple[Stage, int, int]],
) -> None:
    progress = ProgressClock(50, COSTS, clock=Time())
    last = 0.0
    for stage, done, total in reports:
        standing = progress.advance(stage, done, total)
        assert last <= standing.fraction <= 1
        assert 0 <= standing.frames_done <= 50
        last = standing.fraction


def test_costs_move_half_way_to_each_film() -> None:
    costs = StageCosts()
    before = costs.current()
    costs.learn({Stage.DETECTING: 2.0}, pixels=10_000_000)
    assert costs.current() == {**before, Stage.DETECTING: (before[Stage.DETECTING] + 200) / 2}
