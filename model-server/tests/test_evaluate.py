# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import tifffile

from memtrack.__main__ import main
from memtrack.detections import Detections, FrameDetections, Level
from memtrack.detections_io import write_detections
from memtrack.evaluation.charts import Axis, Series, histogram, line_chart
from memtrack.evaluation.evaluate import Evaluation, FilmData, Options, Speeds, evaluate
from memtrack.evaluation.matching import Counts
from memtrack.film import Calibration
from memtrack.pruning import PrunerSettings
from memtrack.tracks import Motility, TrackTable
from memtrack.tracks_io import write_tracks

CALIBRATED = Calibration(0.25, 0.05)
FRAMES = 30


def swimmers(speeds: list[float], frames: int = FRAMES, offset: float = 0.0) -> TrackTable:
    """Tracks side by side, each straight at its speed in pixels a frame."""
    t = np.tile(np.arange(frames), len(speeds))
    ids = np.repeat(np.arange(len(speeds)), frames)
    return TrackTable.of(t, ids, 20 + t * np.array(speeds)[ids] + offset, 40.0 + 60 * ids)


def candidates(truth: TrackTable) -> list[FrameDetections]:
    """The truth found by two levels, with one large box, one faint one and one false one a frame."""
    found = []
    for frame in range(truth.frame_count):
        points = truth.select(truth.frames == frame)
        right = np.stack([points.x - 15, points.y - 15, points.x + 15, points.y + 15], 1)
        extra = np.array([[300, 300, 350, 330], [400, 300, 430, 330], [500, 300, 530, 330]])
        n = len(right)
        found.append(
            FrameDetections(
                frame,
                Detections(
                    np.concatenate([right, right + 0.5, extra]).astype(np.float32),
                    np.array([0.9] * n + [0.8] * n + [0.9, 0.2, 0.7], np.float32),
                    np.array([Level.HIGH] * n + [Level.LOW] * n + [Level.HIGH] * 3, np.int8),
                ),
            )
        )
    return found


def run(tmp_path: Path, *words: str) -> dict[str, Any]:
    assert main(["evaluate", *words, "--out", str(tmp_path / "out")]) == 0
    content: dict[str, Any] = json.loads((tmp_path / "out" / "evaluation.json").read_text(encoding="utf-8"))
    return content


def test_each_step_of_the_pipeline_is_counted() -> None:
    truth = swimmers([1.0, 3.0])
    film = FilmData("a", truth, truth.select(truth.ids == 0), candidates(truth), CALIBRATED)
    options = Options(min_length=31, pruner=PrunerSettings((0.5, 0.5, 0.5)))
    found = evaluate(film, options)
    n, f = 2 * FRAMES, FRAMES
    assert found.steps == {
        "low": Counts(n, 0, 0),
        "medium": Counts(0, 0, n),
        "high": Counts(n, 3 * f, 0),
        "pooled": Counts(n, n + 3 * f, 0),
        "size": Counts(n, n + 2 * f, 0),
        "score": Counts(n, n + f, 0),
        "NMS": Counts(n, f, 0),
        "SORT": Counts(f, 0, f),
        "length": Counts(0, 0, n),
    }
    assert found.result == found.steps["length"]
    assert evaluate(film, Options(min_length=30)).result == Counts(f, 0, f)
    assert found.lengths[30] == Counts(f, 0, f)
    assert found.lengths[40] == Counts(0, 0, n)


def test_tracks_are_counted_by_motility_and_as_false() -> None:
    truth = swimmers([0.0, 0.15, 2.0, 4.0])
    half = truth.select((truth.ids == 2) & (truth.frames < FRAMES // 2))
    false = TrackTable.of(range(9), 5, [500.0] * 9, [500.0] * 9)
    lost = TrackTable.of(range(4), 7, [20.0, 24.0, 700.0, 700.0], [220.0] * 4)  # right for half of its life
    parts = (half, false, lost)
    tracks = TrackTable.of(*(np.concatenate([getattr(part, c) for part in parts]) for c in ("frames", "ids", "x", "y")))
    found = evaluate(FilmData("a", truth, tracks, calibration=CALIBRATED), Options())
    by_class = {m: (c.tracks, c.detected, c.points, c.found) for m, c in found.classes.items() if c.tracks}
    assert by_class == {
        Motility.NONE: (1, 0, 30, 0),
        Motility.LOW: (1, 0, 30, 0),
        Motility.HIGH: (2, 1, 60, 17),
    }
    assert (found.truth_tracks, found.predicted_tracks, found.false_tracks) == (4, 3, 1)


def test_speeds_are_in_micrometres_a_second() -> None:
    truth = swimmers([0.0, 4.0])
    found = evaluate(FilmData("a", truth, truth, calibration=CALIBRATED), Options())
    assert found.truth_speeds.frame_to_frame.tolist() == pytest.approx([0, 4 * 0.25 / 0.05])
    assert found.truth_speeds.over_lag.tolist() == pytest.approx([0, 20])
    assert found.tracked_speeds.of(Motility.HIGH).mean == pytest.approx(20)
    assert found.truth_speeds.standard_error == pytest.approx(10)
    assert len(evaluate(FilmData("a", truth, truth), Options()).truth_speeds.frame_to_frame) == 0


def test_films_add_up() -> None:
    truth = swimmers([1.0, 3.0])
    one = evaluate(FilmData("a", truth, truth, calibration=CALIBRATED), Options())
    two = evaluate(FilmData("b", truth, truth.select(truth.ids == 1), calibration=CALIBRATED), Options())
    both = one + two
    assert both.result == Counts(3 * FRAMES, 0, FRAMES)
    assert both.tracking is not None
    assert both.tracking.measures["IDF1"] == pytest.approx(2 * 3 / 7)
    assert len(both.truth_speeds.motility) == 4
    assert both.classes[Motility.HIGH].tracks == 4
    nothing = Evaluation({"SORT": Counts()})
    assert (nothing + one).tracking == one.tracking
    assert len((Speeds() + one.truth_speeds).over_lag) == 2


def test_the_command_writes_a_page_and_a_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    truth = swimmers([0.0, 1.0, 3.0])
    write_tracks(tmp_path / "truth.csv", truth)
    write_tracks(tmp_path / "tracks.mdf", swimmers([0.0, 1.0, 3.0], offset=1.0))
    write_detections(tmp_path / "d.json", candidates(truth), {"model": "made by hand"})
    content = run(
        tmp_path,
        *("--truth", str(tmp_path / "truth.csv"), "--tracks", str(tmp_path / "tracks.mdf")),
        *("--detections", str(tmp_path / "d.json"), "--thresholds", "0.5,0.5,0.5", "--distance", "6"),
        *("--pixel-size-um", "0.25", "--frame-interval-s", "0.05", "--min-length", "10"),
    )
    assert content["criterion"] == "centres nearer than 6 px"
    assert content["challenge_gate_px"] == 6
    assert (content["all_films"]["F1"], content["all_films"]["RMSE_px"]) == (1, pytest.approx(1))
    # Similarity 5/6 for the 16 thresholds up to 0.8; the three above have no match and count as 1.
    assert content["all_films"]["LocA"] == pytest.approx((16 * 5 / 6 + 3) / 19)
    assert list(content["all_films"]["steps"])[-2:] == ["SORT", "length"]
    assert set(content["curves"]) == {"low", "high", "pooled"}
    # Of the two boxes a cell the worse one falls to NMS: at 0.9 all are found, once, and nothing else.
    best = max(content["curves"]["pooled"], key=lambda point: point["f1"])
    assert (best["tp"], best["fp"], best["fn"]) == (90, 0, 0)
    assert content["all_films"]["speed_um_per_s"]["truth"]["mean"] == pytest.approx(20 / 3)
    table = capsys.readouterr().out.splitlines()
    assert table[0].split()[:4] == ["film", "precision", "recall", "F1"]
    assert table[1].split()[:4] == ["truth", "1.000", "1.000", "1.000"]
    page = (tmp_path / "out" / "evaluation.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 5
    assert "<script" not in page
    assert "nan" not in page.lower()


@pytest.mark.parametrize("ending", ["csv", "xml"])
def test_what_a_truth_ignores_is_neither_right_nor_wrong_to_find(tmp_path: Path, ending: str) -> None:
    truth = swimmers([1.0, 2.0])
    truth = replace(truth, ignored=(truth.ids == 1) & (truth.frames >= 10))
    write_tracks(tmp_path / f"t.{ending}", truth)
    for name, rows in (("all", truth.ids >= 0), ("wanted", ~truth.ignored)):
        write_tracks(tmp_path / f"{name}.csv", truth.select(rows))
        content = run(tmp_path, "--truth", str(tmp_path / f"t.{ending}"), "--tracks", str(tmp_path / f"{name}.csv"))
        counts = content["all_films"]["steps"]["SORT"]
        assert (counts["tp"], counts["fp"], counts["fn"]) == (FRAMES + 10, 0, 0)


def test_a_list_of_films_gives_a_line_each_and_one_for_all(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_tracks(tmp_path / "a.csv", swimmers([1.0, 2.0]))
    write_tracks(tmp_path / "b.csv", swimmers([1.0]))
    (tmp_path / "films.csv").write_text(
        "film,truth,tracks,pixel_size_um,frame_interval_s\n<a>,a.csv,b.csv,0.25,0.05\nb,b.csv,b.csv,0.25,\n",
        encoding="utf-8",
    )
    content = run(tmp_path, "--films", str(tmp_path / "films.csv"), "--frame-interval-s", "0.1")
    assert list(content["films"]) == ["<a>", "b"]
    assert content["all_films"]["steps"]["SORT"] == {
        "tp": 60, "fp": 0, "fn": 30, "precision": 1, "recall": pytest.approx(2 / 3), "f1": pytest.approx(0.8)
    }  # fmt: skip
    assert content["films"]["b"]["speed_um_per_s"]["truth"]["mean"] == pytest.approx(2.5)
    assert content["films"]["b"]["speed_um_per_s"]["t_test"]["p"] is None
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == ["film", "<a>", "b", "all"]
    assert "&lt;a&gt;" in (tmp_path / "out" / "evaluation.html").read_text(encoding="utf-8")


def test_baselines_are_shown_at_their_best_on_this_truth(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    truth = swimmers([1.0, 2.0], frames=6)
    write_tracks(tmp_path / "t.csv", truth)
    frames = np.full((6, 160, 120), 90, np.uint8)
    for t, x, y in zip(truth.frames, truth.x.astype(int), truth.y.astype(int), strict=True):
        frames[t, y - 1 : y + 2, x - 2 : x + 3] = 160
    tifffile.imwrite(tmp_path / "film.tif", frames, imagej=True, metadata={"axes": "TYX"})
    same = ("--truth", str(tmp_path / "t.csv"), "--tracks", str(tmp_path / "t.csv"))
    content = run(tmp_path, *same, "--video", str(tmp_path / "film.tif"), "--baselines", "log")
    log = content["baselines_tuned_on_this_truth"]["log"]
    assert (log["tp"], log["fp"], log["fn"]) == (12, 0, 0)
    assert log["sign"] in ("bright", "both")
    assert "log with settings tuned on this truth" in capsys.readouterr().out
    assert "log with settings tuned on this truth" in (tmp_path / "out" / "evaluation.html").read_text(encoding="utf-8")


def test_detections_alone_can_be_judged(tmp_path: Path) -> None:
    truth = swimmers([1.0])
    write_tracks(tmp_path / "t.xml", truth)
    write_detections(tmp_path / "d.csv", candidates(truth), {})
    content = run(tmp_path, "--truth", str(tmp_path / "t.xml"), "--detections", str(tmp_path / "d.csv"))
    assert list(content["all_films"]["steps"]) == ["low", "medium", "high", "pooled"]
    assert content["all_films"]["recall"] == 1
    assert "HOTA" not in content["all_films"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "no truth is given"),
        (["--truth", "t.csv"], "nothing is given to compare"),
        (["--truth", "t.csv", "--tracks", "none.csv"], "cannot read"),
        (["--truth", "t.csv", "--tracks", "t.csv", "--min-length", "0"], "--min-length is 0"),
        (["--truth", "t.csv", "--tracks", "t.csv", "--thresholds", "0.5,2,0.5"], "thresholds are 0.5, 2.0, 0.5"),
        (["--truth", "t.csv", "--tracks", "t.csv", "--thresholds", "0.5,x"], "--thresholds is '0.5,x'"),
        (["--truth", "t.csv", "--tracks", "t.csv", "--baselines", "log"], "give --video"),
        (["--films", "f.csv", "--truth", "t.csv"], "--films names the files"),
        (["--films", "t.csv"], "has no column film"),
        (["--films", "mixed.csv"], "film b has no tracks while others have"),
        (["--films", "twice.csv"], "line 3"),
        (["--films", "size.csv"], "has '-1', expected a positive number"),
        (["--films", "empty.csv"], "lists no film"),
    ],
)
def test_a_mistake_gets_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, words: list[str], message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    write_tracks(Path("t.csv"), swimmers([1.0]))
    for name, text in {
        "mixed": "film,truth,tracks\na,t.csv,t.csv\nb,t.csv,\n",
        "twice": "film,truth,tracks\na,t.csv,t.csv\na,t.csv,t.csv\n",
        "size": "film,truth,tracks,pixel_size_um\na,t.csv,t.csv,-1\n",
        "empty": "film,truth,tracks\n",
    }.items():
        Path(f"{name}.csv").write_text(text, encoding="utf-8")
    assert main(["evaluate", *words, "--out", "out"]) == 2
    printed = capsys.readouterr()
    assert message in printed.err
    assert printed.err.count("\n") == 1
    assert not Path("out").exists()


def test_figures_are_well_formed_and_hold_every_point() -> None:
    svg = line_chart([Series("a < b", [0, 1, 2], [0.5, float("nan"), 1.0])], Axis("x & y", 0, 2), Axis("", 0, 1))
    root = ElementTree.fromstring(svg)
    dots = [dot for dot in root.iter() if dot.tag.endswith("circle")]
    assert len(dots) == 2
    assert (float(dots[0].get("cx", "")), float(dots[1].get("cx", ""))) == (56, 544)
    bars = [
        bar
        for bar in ElementTree.fromstring(histogram([("t", np.array([1.0, 1, 5])), ("p", np.array([]))], "v")).iter()
        if bar.tag.endswith("rect") and bar.get("fill-opacity")
    ]
    assert len(bars) == 2
    heights = [float(bar.get("height", "")) for bar in bars]
    assert heights[0] == pytest.approx(2 * heights[1], rel=0.01)


def test_axes_take_round_numbers() -> None:
    assert [word for _, word in Axis("", 0, 1).ticks()] == ["0", "0.2", "0.4", "0.6", "0.8", "1"]
    assert [word for _, word in Axis("", 3, 61).ticks()] == ["20", "40", "60"]
