# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memtrack.detections import Detections, FrameDetections
from memtrack.detections_io import files_of, read_detections, write_detections
from memtrack.errors import InvalidInputError

FRAMES = [
    FrameDetections(
        0,
        Detections(
            np.array([[1.25, 2, 31.25, 32], [-3.5, 0, 26.5, 30]], np.float32),
            np.array([0.9, 0.25], np.float32),
            np.array([2, 0], np.int8),
        ),
    ),
    FrameDetections(1, Detections.empty()),
]


def assert_same(ours: list[FrameDetections], theirs: list[FrameDetections]) -> None:
    assert [f.frame for f in ours] == [f.frame for f in theirs]
    for a, b in zip(ours, theirs, strict=True):
        np.testing.assert_allclose(a.detections.boxes, b.detections.boxes, atol=6e-4)
        np.testing.assert_allclose(a.detections.scores, b.detections.scores, atol=6e-5)
        np.testing.assert_array_equal(a.detections.levels, b.detections.levels)


def test_a_csv_has_one_header_row_and_its_provenance_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "détections 细菌.csv"
    beside = tmp_path / "détections 细菌.provenance.json"
    assert write_detections(path, FRAMES, {"model": "ä"}) == [path, beside]
    assert path.read_bytes() == (
        b"frame,x_min,y_min,x_max,y_max,score,level\n0,1.25,2.0,31.25,32.0,0.9,high\n0,-3.5,0.0,26.5,30.0,0.25,low\n"
    )
    assert json.loads(beside.read_text(encoding="utf-8")) == {"model": "ä", "frame_count": 2}
    assert_same(read_detections(path), FRAMES[:1])


def test_json_keeps_empty_frames_too(tmp_path: Path) -> None:
    path = tmp_path / "detections.json"
    assert write_detections(path, FRAMES, {"model": "x"}) == [path]
    assert json.loads(path.read_text(encoding="utf-8"))["provenance"] == {"model": "x"}
    assert_same(read_detections(path), FRAMES)


edges = st.floats(-1000, 1000, width=32)
boxes = st.tuples(edges, edges, st.floats(0, 500, width=32), st.floats(0, 500, width=32))


@given(st.lists(st.lists(st.tuples(boxes, st.floats(0, 1, width=32), st.integers(0, 2)), max_size=4), max_size=5))
def test_what_is_written_is_read_back(
    tmp_path_factory: pytest.TempPathFactory, world: list[list[tuple[tuple[float, ...], float, int]]]
) -> None:
    frames = []
    for i, rows in enumerate(world):
        table = np.array([(x, y, x + w, y + h) for (x, y, w, h), _, _ in rows], np.float32).reshape(-1, 4)
        scores = np.array([score for _, score, _ in rows], np.float32)
        levels = np.array([level for _, _, level in rows], np.int8)
        frames.append(FrameDetections(i, Detections(table, scores, levels)))
    path = tmp_path_factory.mktemp("io") / "d.json"
    write_detections(path, frames, {})
    assert_same(read_detections(path), frames)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("frame,x_min\n", "lacks the column"),
        ("frame,x_min,y_min,x_max,y_max,score,level\n0,1,2,3,4,0.5\n", "detection 1: "),
        ("frame,x_min,y_min,x_max,y_max,score,level\n0,1,2,3,4,0.5,huge\n", "HUGE"),
        ("frame,x_min,y_min,x_max,y_max,score,level\n0,1,2,3,4,1.5,low\n", r"score 1\.5 not in 0 to 1"),
        ("frame,x_min,y_min,x_max,y_max,score,level\n0,5,2,3,4,0.5,low\n", "is inside out"),
        ("frame,x_min,y_min,x_max,y_max,score,level\n-1,1,2,3,4,0.5,low\n", "frame -1 .* out of range"),
        ("frame,x_min,y_min,x_max,y_max,score,level\n0,nan,2,3,4,0.5,low\n", "out of range"),
        ("frame,x_min,y_min,x_max,y_max,score,level\nzero,1,2,3,4,0.5,low\n", "zero"),
    ],
)
def test_rows_that_make_no_sense_are_named(tmp_path: Path, text: str, sentence: str) -> None:
    path = tmp_path / "d.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInputError, match=sentence):
        read_detections(path)


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"detections": 3, "frame_count": 1}', "null"])
def test_json_of_another_kind_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "d.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInputError, match=r"d\.json"):
        read_detections(path)


def test_what_cannot_replace_a_file_is_kept_beside_it_and_a_table_goes_first(tmp_path: Path) -> None:
    path, beside = files_of(tmp_path / "d.csv")
    beside.mkdir()  # cannot be replaced by a file, as one that is open on Windows
    with pytest.raises(InvalidInputError, match=r"cannot replace .*d\.provenance\.json: .* rename \.d\.prov") as caught:
        write_detections(path, FRAMES, {"model": "x"})
    assert_same(read_detections(path), FRAMES[:1])
    (kept,) = (file for file in tmp_path.iterdir() if file not in (path, beside))
    assert kept.name in str(caught.value)
    assert json.loads(kept.read_text(encoding="utf-8")) == {"model": "x", "frame_count": 2}


def test_another_suffix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InvalidInputError, match=r"d\.xls must end in \.csv or \.json"):
        write_detections(tmp_path / "d.xls", FRAMES, {})
