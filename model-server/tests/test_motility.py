# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import math

import numpy as np
import pytest

from memtrack.evaluation.welch import welch_t_test
from memtrack.film import Calibration
from memtrack.motility import (
    displacements,
    frames_in,
    lag_speed,
    mean_speed,
    mean_squared_displacement,
    motility_of,
    peak_diffusivity,
    track_motility,
)
from memtrack.tracks import Motility, TrackTable


def track(frames: list[int], x: list[float], y: list[float] | float = 0.0, **columns: object) -> TrackTable:
    return TrackTable.of(frames, 0, x, np.broadcast_to(y, len(frames)), **columns)  # type: ignore[arg-type]


def test_displacements_span_a_lag_exactly_and_leave_gaps_out() -> None:
    gap = track([0, 1, 2, 5, 6], [0, 3, 3, 10, 14], [0, 4, 4, 4, 4])
    assert displacements(gap, 1).tolist() == [5, 0, 4]
    assert displacements(gap, 2).tolist() == [5]
    assert displacements(gap, 4).tolist() == pytest.approx([7, 11])
    assert displacements(gap, 7).tolist() == []
    assert mean_speed(gap) == (5 + 0 + 7 + 4) / 6
    assert lag_speed(gap, 4) == pytest.approx(9 / 4)
    assert math.isnan(lag_speed(gap, 7))
    assert math.isnan(mean_speed(track([3], [1.0])))


def test_a_straight_swimmer_has_the_msd_of_its_speed() -> None:
    swimmer = track(list(range(60)), [2.0 * t for t in range(60)])
    assert mean_squared_displacement(swimmer, np.array([1, 5, 59, 60])) == pytest.approx(
        [4, 100, 118**2, np.nan], nan_ok=True
    )
    # D(lag) = v^2 lag / 4 is greatest at the longest lag: 2.5 s, or 10 frames, half of a short track.
    calibration = Calibration(pixel_size_um=0.5, frame_interval_seconds=0.1)
    speed = 2 * 0.5 / 0.1
    assert peak_diffusivity(swimmer, calibration) == pytest.approx(speed**2 * 2.5 / 4)
    assert peak_diffusivity(swimmer.select(np.arange(21)), calibration) == pytest.approx(speed**2 * 1.0 / 4)


def test_interpolated_points_are_not_measured() -> None:
    guessed = track([0, 1, 2, 3], [0, 100, 4, 6], interpolated=[False, True, False, False])
    assert mean_speed(guessed) == 6 / 3
    assert lag_speed(guessed, 1) == 2
    assert mean_speed(track([0, 1], [0, 5], interpolated=True)) == 5


def test_frames_are_rounded_half_up() -> None:
    assert [frames_in(0.1, interval) for interval in (1 / 60, 0.04, 1 / 26.87, 1.0)] == [6, 3, 3, 1]


def test_brownian_motion_has_the_diffusivity_it_was_made_with() -> None:
    rng = np.random.default_rng(3)
    interval, pixel, made = 1 / 60, 0.25, 0.5
    steps = rng.normal(0, math.sqrt(2 * made * interval) / pixel, (2, 20_000))
    x, y = np.cumsum(steps, axis=1)
    walker = TrackTable.of(range(20_000), 0, x, y)
    assert 0.8 * made < peak_diffusivity(walker, Calibration(pixel, interval)) < 1.4 * made
    lags = np.array([15, 30, 60])
    found = mean_squared_displacement(walker, lags) * pixel**2 / (4 * lags * interval)
    assert found == pytest.approx([made] * 3, rel=0.1)
    assert track_motility(walker, Calibration(pixel, interval)) is Motility.MEDIUM


def test_a_cell_at_rest_stays_without_motility_though_its_position_jitters() -> None:
    rng = np.random.default_rng(5)
    rest = TrackTable.of(range(600), 0, *(100 + rng.normal(0, 0.5, (2, 600))))
    assert track_motility(rest, Calibration(0.2475, 1 / 60)) is Motility.NONE


@pytest.mark.parametrize(
    ("diffusivity", "motility"),
    [(0, "NONE"), (0.075, "NONE"), (0.0751, "LOW"), (0.25, "LOW"), (0.26, "MEDIUM"), (1, "MEDIUM"), (1.01, "HIGH")],
)
def test_classes_end_where_the_paper_says(diffusivity: float, motility: str) -> None:
    assert motility_of(diffusivity) is Motility[motility]


def test_the_class_of_a_file_goes_before_the_measured_one_and_nothing_is_unknown() -> None:
    calibration = Calibration(0.25, 1 / 60)
    fast = track(list(range(40)), [3.0 * t for t in range(40)])
    assert track_motility(fast, calibration) is Motility.HIGH
    assert track_motility(fast, Calibration()) is Motility.UNKNOWN
    assert track_motility(track([0, 1], [0, 9]), calibration) is Motility.UNKNOWN
    assert track_motility(track([3], [0]), calibration) is Motility.UNKNOWN
    named = track(list(range(3)), [0, 9, 18], motility=[Motility.LOW, Motility.UNKNOWN, Motility.LOW])
    assert track_motility(named, calibration) is Motility.LOW


@pytest.mark.parametrize(
    ("first", "second", "t", "degrees", "p"),
    [
        # scipy 1.17.1, ttest_ind(equal_var=False)
        (
            [8.1, 9.4, 7.7, 8.8, 10.2],
            [9.9, 12.5, 11.0, 8.2, 13.1, 9.7, 10.6],
            -2.409494173455,
            9.808354255252,
            0.037163561425,
        ),
        ([1, 2, 3], [1.5, 2.5, 3.5, 40], -1.050349908447, 3.022690504199, 0.370178924274),
        (list(range(100)), [x * 0.1 + 200 for x in range(50)], -52.58788329465, 99.99717484250, 1.1219555265769e-74),
    ],
)
def test_the_t_test_agrees_with_scipy(
    first: list[float], second: list[float], t: float, degrees: float, p: float
) -> None:
    test = welch_t_test(np.array(first, float), np.array(second, float))
    assert (test.t, test.degrees) == pytest.approx((t, degrees))
    assert test.p == pytest.approx(p, rel=1e-8, abs=0)


def test_the_t_test_of_too_little_is_undefined() -> None:
    assert math.isnan(welch_t_test(np.array([1.0]), np.array([1.0, 2.0])).p)
    assert math.isnan(welch_t_test(np.array([1.0, 1.0]), np.array([2.0, 2.0])).p)
    assert welch_t_test(np.array([1.0, 3.0]), np.array([1.0, 3.0])).p == pytest.approx(1.0)
