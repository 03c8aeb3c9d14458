# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import math

import numpy as np
import pytest

from memtrack.evaluation.matching import Criterion, compare
from memtrack.evaluation.tracking_measures import TrackingSums, tracking_sums
from memtrack.tracks import TrackTable

# track, frame, x, y. A crossing that swaps two tracks, a gap, a track cut in two, and a false track.
TRUTH = """
1,0,10,10 1,1,14,11 1,2,18,12 1,3,22,13 1,4,26,14 1,5,30,15
2,0,60,12 2,1,55,12 2,2,49,13 2,3,43,13 2,4,37,14 2,5,31,14 2,6,25,15
3,2,90,80 3,3,90,81 3,5,91,82 3,6,91,83 3,7,92,84
"""
PREDICTED = """
11,0,11,10 11,1,15,13 11,2,17,12 11,3,23,11 11,4,33,15 11,5,32,14 11,6,26,16
12,0,62,11 12,1,54,13 12,2,50,13 12,4,28,13 12,5,29,17
13,3,89,80 13,4,88,81 13,5,94,84
14,6,90,82 14,7,97,88 15,1,150,150 15,2,151,150
"""


def tracks(text: str) -> TrackTable:
    ids, frames, x, y = np.array([point.split(",") for point in text.split()], float).T
    return TrackTable.of(frames, ids, x, y)


def straight(track: int, first: int, last: int) -> str:
    return " ".join(f"{track},{t},{20 + 2 * t},40" for t in range(first, last + 1))


def measures(truth: TrackTable, predicted: TrackTable, criterion: Criterion = Criterion()) -> dict[str, float]:  # noqa: B008
    return tracking_sums(compare(truth, predicted, criterion)).measures


@pytest.mark.parametrize(
    ("criterion", "expected"),
    [
        (
            Criterion(),
            {"HOTA": 0.540334494365, "DetA": 0.583873067077, "AssA": 0.501005048868, "LocA": 0.836521950571}
            | {"IDF1": 0.702702702703, "MOTA": 0.611111111111},
        ),
        (
            Criterion(distance_px=6),
            {"HOTA": 0.347419529877, "DetA": 0.415149475642, "AssA": 0.29267070753, "LocA": 0.759858245025}
            | {"IDF1": 0.594594594595, "MOTA": 0.444444444444},
        ),
        (
            Criterion(iou=0.5, box_size_px=20),
            {"HOTA": 0.472764381392, "DetA": 0.50900575173, "AssA": 0.440831975363, "LocA": 0.792643535136}
            | {"IDF1": 0.594594594595, "MOTA": 0.444444444444},
        ),
    ],
    ids=str,
)
def test_measures_are_those_of_the_reference_code(criterion: Criterion, expected: dict[str, float]) -> None:
    # Computed with TrackEval 1.3.0 (Hota, Identity, Clear); MOTA and IDF1 also with py-motmetrics 1.4.0.
    assert measures(tracks(TRUTH), tracks(PREDICTED), criterion) == pytest.approx(expected, abs=1e-11)


def test_the_truth_itself_is_perfect() -> None:
    assert set(measures(tracks(TRUTH), tracks(TRUTH)).values()) == {1.0}


def test_a_track_cut_in_the_middle_keeps_its_detections_but_half_its_association() -> None:
    # Each true positive's pair shares 5 of 10 + 5 - 5 points: AssA = 1/2, HOTA = sqrt(1/2), one switch in ten.
    found = measures(tracks(straight(1, 0, 9)), tracks(straight(7, 0, 4) + " " + straight(8, 5, 9)))
    expected = {"HOTA": math.sqrt(0.5), "DetA": 1, "AssA": 0.5, "LocA": 1, "IDF1": 2 * 5 / 20, "MOTA": 1 - 1 / 10}
    assert found == pytest.approx(expected)


def test_a_track_found_for_half_its_life_and_a_false_one() -> None:
    # 5 of 10 found, 3 false: DetA = 5/13, AssA = 5/10, IDF1 = 10/18, MOTA = 1 - (5 + 3)/10.
    false = "9,0,300,300 9,1,300,300 9,2,300,300"
    found = measures(tracks(straight(1, 0, 9)), tracks(straight(7, 0, 4) + " " + false))
    expected = {"HOTA": math.sqrt(5 / 13 * 0.5), "DetA": 5 / 13, "AssA": 0.5, "LocA": 1, "IDF1": 10 / 18, "MOTA": 0.2}
    assert found == pytest.approx(expected)


def test_a_pair_is_kept_from_frame_to_frame_but_not_over_a_gap() -> None:
    # In frame 2 the prediction 8 is nearer than 7. With 7 there in frame 1 the pair stays: no switch, 8 is false.
    truth = tracks("1,0,20,40 1,1,20,40 1,2,20,40 2,1,90,90")
    through = tracks("7,0,20,40 7,1,20,40 7,2,22,40 8,2,20,40 9,1,90,90")
    assert measures(truth, through)["MOTA"] == pytest.approx(1 - 1 / 4)
    # Without it the nearer one is taken: one point missed, one false, one switch.
    gap = tracks("7,0,20,40 7,2,22,40 8,2,20,40 9,1,90,90")
    assert measures(truth, gap)["MOTA"] == pytest.approx(1 - 3 / 4)


def test_the_sums_of_films_add_up_like_one_film_of_both() -> None:
    one, two = tracks(straight(1, 0, 9)), tracks(straight(7, 0, 4))
    apart = tracking_sums(compare(one, two, Criterion())) + tracking_sums(
        compare(tracks(TRUTH), tracks(PREDICTED), Criterion())
    )
    later = tracks(TRUTH.replace("\n", " "))
    shifted_truth = TrackTable.of(
        [*one.frames, *later.frames + 50], [*one.ids, *later.ids + 100], [*one.x, *later.x], [*one.y, *later.y]
    )
    found = tracks(PREDICTED)
    shifted_found = TrackTable.of(
        [*two.frames, *found.frames + 50], [*two.ids, *found.ids + 100], [*two.x, *found.x], [*two.y, *found.y]
    )
    assert apart.measures == pytest.approx(measures(shifted_truth, shifted_found))


def test_nothing_found_and_nothing_to_find() -> None:
    empty = TrackTable.of([], [], [], [])
    found = measures(tracks(TRUTH), empty)
    assert (found["HOTA"], found["IDF1"], found["MOTA"]) == (0, 0, 0)
    false = measures(empty, tracks(PREDICTED))
    assert (false["HOTA"], false["IDF1"]) == (0, 0)
    assert math.isnan(false["MOTA"])
    assert all(math.isnan(value) for value in TrackingSums().measures.values())
