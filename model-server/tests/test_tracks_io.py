# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
import random
import re
from pathlib import Path

import numpy as np
import pytest

from memtrack.errors import InvalidInputError
from memtrack.film import Calibration
from memtrack.formats.trackmate_writer import FilmFile
from memtrack.tracks import UNLINKED, Motility, TrackTable
from memtrack.tracks_io import read_tracks, write_tracks


@pytest.fixture
def field_data() -> Path:
    """Real files made by other programs."""
    folder = os.environ.get("MEMTRACK_DATA")
    if folder is None or not Path(folder).is_dir():
        if os.environ.get("CI") == "true":
            pytest.fail("MEMTRACK_DATA does not name the folder of real films")
        pytest.skip("set MEMTRACK_DATA to the folder of real films to run this test")
    return Path(folder)


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8", newline="")
    return path


def two_tracks(**columns: object) -> TrackTable:
    return TrackTable.of([4, 2, 3, 2], [7, 7, 7, 1], [1.5, 2.5, 3.25, 40], [9, 8, 7, 60.125], **columns)  # type: ignore[arg-type]


def test_a_table_is_sorted_by_track_then_frame() -> None:
    table = two_tracks()
    assert table.ids.tolist() == [1, 7, 7, 7]
    assert table.frames.tolist() == [2, 2, 3, 4]
    assert table.x.tolist() == [40, 2.5, 3.25, 1.5]
    assert [len(track) for track in table.tracks()] == [1, 3]
    assert table.lengths.tolist() == [1, 3, 3, 3]
    assert table.frame_count == 5


def test_unlinked_detections_may_share_a_frame_but_points_of_a_track_may_not() -> None:
    table = TrackTable.of([0, 0, 5, 9], [UNLINKED, UNLINKED, 3, 3], [1, 2, 3, 4], [1, 2, 3, 4])
    assert table.track_ids.tolist() == [3]
    assert [track.frames.tolist() for track in table.tracks()] == [[5, 9]]
    assert list(table.select(table.ids == UNLINKED).tracks()) == []
    assert table.lengths.tolist() == [1, 1, 5, 5]
    with pytest.raises(ValueError, match="track 3 has two points in frame 0"):
        TrackTable.of([0, 0], [3, 3], [1, 2], [1, 2])


@pytest.mark.parametrize(
    ("frames", "ids", "x", "message"),
    [([-1], [0], [1.0], "frame -1"), ([0], [-2], [1.0], "track id -2"), ([0], [0], [np.nan], "finite")],
)
def test_impossible_points_are_refused(frames: list[int], ids: list[int], x: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        TrackTable.of(frames, ids, x, [0.0])


def test_boxes_stand_around_the_centre_and_a_default_fills_in() -> None:
    table = TrackTable.of([0, 1], [0, 0], [10, 20], [30, 40], width=[4, np.nan], height=[6, np.nan])
    assert table.with_boxes(30).boxes.tolist() == [[8, 27, 12, 33], [5, 25, 35, 55]]


@pytest.mark.parametrize("ending", ["csv", "mdf", "xml"])
def test_tracks_come_back_as_they_were_written(tmp_path: Path, ending: str) -> None:
    table = two_tracks(
        width=[10, 10, 10, 12],
        height=[10, 10, 10, 12],
        scores=[0.5, 0.25, 1, 0.75],
        interpolated=[False, True, False, False],
        motility=[Motility.HIGH] * 3 + [Motility.NONE],
        calibration=Calibration(0.25, 0.5),
    )
    path = tmp_path / f"Spuren [ä 細菌].{ending}"
    write_tracks(path, table)
    back = read_tracks(path, linked_only=False)
    order = np.lexsort((back.x, back.frames))
    expected = np.lexsort((table.x, table.frames))
    assert back.frames[order].tolist() == table.frames[expected].tolist()
    np.testing.assert_allclose(back.x[order], table.x[expected], atol=1e-4)
    np.testing.assert_allclose(back.y[order], table.y[expected], atol=1e-4)
    assert [len(track) for track in back.tracks()] == ([3] if ending == "xml" else [1, 3])
    assert back.interpolated[order].tolist() == table.interpolated[expected].tolist()
    if ending != "mdf":
        np.testing.assert_allclose(back.boxes[order], table.boxes[expected], atol=1e-4)
        assert back.scores[order].tolist() == table.scores[expected].tolist()
    if ending == "csv":
        assert back.motility[order].tolist() == table.motility[expected].tolist()
    if ending == "xml":
        assert back.motility[back.ids != UNLINKED].tolist() == [Motility.HIGH] * 3
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("ending", ["csv", "xml", "mdf"])
def test_ignored_rows_are_marked_or_left_out(tmp_path: Path, ending: str) -> None:
    table = TrackTable.of(
        [0, 1, 2, 0, 1], [0, 0, 0, 1, 1], [1, 2, 3, 4, 5], 6.0, ignored=[False, True, False, False, True]
    )
    path = tmp_path / f"a.{ending}"
    write_tracks(path, table)
    back = read_tracks(path)
    if ending == "mdf":
        assert (back.frames.tolist(), back.x.tolist()) == ([0, 2, 0], [1, 3, 4])
    else:
        assert (back.frames.tolist(), back.ignored.tolist()) == (table.frames.tolist(), table.ignored.tolist())
    text = path.read_text(encoding="utf-8")
    assert (text.count('feature="MEMTRACK_IGNORED"'), text.count('MEMTRACK_IGNORED="')) == (
        (1, 5) if ending == "xml" else (0, 0)
    )
    write_tracks(path, table.select(~table.ignored))
    assert "MEMTRACK_IGNORED" not in path.read_text(encoding="utf-8")


def test_a_trackmate_file_names_its_film_and_units(tmp_path: Path) -> None:
    film = FilmFile(tmp_path / "film.tif", 660, 492, 60)
    write_tracks(tmp_path / "a.xml", two_tracks(calibration=Calibration(0.2475, 1 / 60)), film=film)
    back = read_tracks(tmp_path / "a.xml")
    assert back.calibration.pixel_size_um == 0.2475
    assert back.calibration.frame_interval_seconds == pytest.approx(1 / 60)
    np.testing.assert_allclose(back.x, [2.5, 3.25, 1.5])
    assert f'folder="{tmp_path}{os.sep}"' in (tmp_path / "a.xml").read_text(encoding="utf-8")


def test_a_trackmate_file_of_pixels_that_are_not_square_is_read_by_their_width_and_height(tmp_path: Path) -> None:
    boxed = two_tracks(width=10, height=8, calibration=Calibration(0.25, 0.5))
    write_tracks(tmp_path / "a.xml", boxed)
    text = (tmp_path / "a.xml").read_text(encoding="utf-8")
    table = read_tracks(write(tmp_path / "a.xml", text.replace('pixelheight="0.25"', 'pixelheight="0.5"')))
    np.testing.assert_allclose(table.x, [2.5, 3.25, 1.5])
    np.testing.assert_allclose(table.y, [4, 3.5, 4.5])
    assert (table.width[0], table.height[0]) == (10, 4)
    without = read_tracks(write(tmp_path / "b.xml", text.replace('pixelheight="0.25"', "")))
    np.testing.assert_allclose(without.y, [8, 7, 9])


def test_a_truth_table_says_which_rows_are_neither_right_nor_wrong(tmp_path: Path) -> None:
    path = write(
        tmp_path / "t.csv",
        "frame,id,x,y,cls,motility,edge\n0,1.0,5,6,bacterium,swimming,0\n"
        "1,1.0,5,6,bacterium,mid,1\r\n\n0,2.0,1,2,debris,none,0\n",
    )
    table = read_tracks(path)
    assert table.ignored.tolist() == [False, True, True]
    assert table.motility.tolist() == [Motility.UNKNOWN, Motility.MEDIUM, Motility.NONE]
    assert np.isnan(table.width).all()


def test_a_table_of_the_plug_in_tells_its_calibration(tmp_path: Path) -> None:
    text = """track,frame,time_s,x,y,x_um,y_um,width,height,score,level,interpolated,motility
0,0,0.0000,353.0637,81.0820,87.3833,20.0678,30.0000,31.0000,0.9995,high,0,high
0,1,0.0167,352.5539,83.0260,87.2571,20.5489,30.0000,31.0000,,,1,high
2,59,0.9833,12.0000,3.5000,2.9700,0.8663,30.0000,31.0000,0.5000,low,0,
"""
    table = read_tracks(write(tmp_path / "film.csv", text))
    assert table.calibration.pixel_size_um == pytest.approx(0.2475, rel=1e-5)
    assert table.calibration.frame_interval_seconds == pytest.approx(1 / 60, rel=1e-4)
    assert table.interpolated.tolist() == [False, True, False]
    assert np.isnan(table.scores).tolist() == [False, True, False]
    assert table.motility.tolist() == [Motility.HIGH, Motility.HIGH, Motility.UNKNOWN]
    write_tracks(tmp_path / "again.csv", table)
    assert read_tracks(tmp_path / "again.csv").calibration.pixel_size_um == pytest.approx(0.2475, rel=1e-5)
    assert read_tracks(tmp_path / "again.csv", Calibration(0.1)).calibration.pixel_size_um == 0.1
    without = write(tmp_path / "none.csv", "track,frame,time_s,x,y,x_um\n1,0,0.5,0,3,\n")
    assert read_tracks(without).calibration == Calibration()


@pytest.mark.parametrize("header", ["id,track,frame,x,y", "track,id,frame,x,y", "id,TRACK_ID,frame,x,y"])
def test_an_id_beside_a_track_is_that_of_a_spot(tmp_path: Path, header: str) -> None:
    rows = {"id": "7", "track": "2", "TRACK_ID": "2", "frame": "3", "x": "1.5", "y": "4"}
    line = ",".join(rows[name] for name in header.split(","))
    table = read_tracks(write(tmp_path / "film.csv", f"{header}\n{line}\n"))
    assert (table.ids.tolist(), table.frames.tolist(), table.x.tolist(), table.y.tolist()) == ([2], [3], [1.5], [4])
    assert read_tracks(write(tmp_path / "old.csv", "id,frame,x,y\n7,3,1.5,4\n")).ids.tolist() == [7]


def test_the_authors_table_counts_frames_from_one(tmp_path: Path) -> None:
    text = "Nr,TID,PID,x [pixel],y [pixel],t [sec],α [deg],Subpopulation\n1,1,1,3.5,4,0,NA,H\n2,1,2,3,5,0,NA,H\n"
    table = read_tracks(write(tmp_path / "Raw Data.csv", text))
    assert table.frames.tolist() == [0, 1]
    assert table.x.tolist() == [3.5, 3]
    assert table.motility.tolist() == [Motility.HIGH] * 2
    (tmp_path / "old.csv").write_bytes("TID;PID;x [pixel];y [pixel];v [µm]\n1;2;3;4;5\n".encode("latin-1"))
    assert read_tracks(tmp_path / "old.csv").frames.tolist() == [1]


def test_challenge_files_count_frames_from_one_and_give_corners(tmp_path: Path) -> None:
    path = write(tmp_path / "det.txt", "1,-1,10,20,30,40,0.5,-1,-1,-1\n\n3,4,0,0,2,2\n")
    table = read_tracks(path, linked_only=False)
    assert table.frames.tolist() == [0, 2]
    assert table.ids.tolist() == [UNLINKED, 4]
    assert table.boxes.tolist() == [[10, 20, 40, 60], [0, 0, 2, 2]]
    assert len(read_tracks(path)) == 1


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.csv", "frame,id,x\n1,2,3\n", "no column for y"),
        ("a.csv", "", "no column for track, frame, x, y"),
        ("a.csv", "frame,id,x,y\n1,2,3,4\n1.5,2,3,4\n", "line 3 has '1.5' for frame"),
        ("a.csv", "frame,id,x,y\n1,2,,4\n", "line 2 has '' for x"),
        ("a.csv", "frame,id,x,y\n1,2,three,4\n", "line 2 has 'three' for x"),
        ("a.csv", "frame,id,x,y\n1,2,3,4\n1,2,3,4\n", "two points in frame 1"),
        ("a.csv", "frame,id,x,y\n1e300,2,3,4\n", "a frame is not a number from"),
        ("a.csv", "frame,id,x,y\n1,99999999999999999999,3,4\n", "a track id is not a number from"),
        ("a.csv", "frame,id,x,y\n1,2,3,4\r4,4\n", "line 3 has '' for x"),
        pytest.param("a.csv", 'frame,id,x,y\n"' + "1" * 200_000, "not a table", id="endless cell"),
        ("a.txt", "1e40,1,1,1,1,1\n", "a frame is not"),
        ("a.mdf", "MTrackJ 1.5.1 Data File\nTrack 1\nPoint 1 1 1 1 1e40 1\n", "a frame is not"),
        ("a.xml", "<?xml version='1.0' encoding='UTF-88'?><TrackMate/>", "not well-formed"),
        ("a.txt", "1,1,1,1,1\n", "line 1"),
        ("a.mdf", "TrackMate\n", "first line"),
        ("a.mdf", "MTrackJ 1.5.1 Data File\nPoint 1 1 1 1 1 1\n", "before any track"),
        ("a.mdf", "MTrackJ 1.5.1 Data File\nTrack 1\nPoint 1 1 nan 1 1 1\n", "line 3"),
        ("a.mdf", "MTrackJ 1.5.1 Data File\nTrack 1\nPoint 1 1\n", "line 3"),
        ("a.xml", "<TrackMate", "not well-formed"),
        ("a.xml", "<html/>", "<html>"),
        ("a.xml", "<TrackMate version='8'/>", "no <Model>"),
        ("a.xml", "<!DOCTYPE x [<!ENTITY e 'x'>]><TrackMate>&e;</TrackMate>", "document type"),
        ("a.xml", "<Tracks spaceUnits='micron'/>", "--pixel-size-um"),
        ("a.json", "{}", "does not end in"),
    ],
)
def test_a_bad_file_gets_one_clear_sentence(tmp_path: Path, name: str, text: str, message: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        read_tracks(write(tmp_path / name, text))
    assert message in str(caught.value)
    assert name in str(caught.value) or "--pixel-size-um" in message


def test_a_missing_file_and_a_missing_folder_are_told(tmp_path: Path) -> None:
    for ending in ("csv", "mdf", "xml", "txt"):
        with pytest.raises(InvalidInputError, match="cannot read"):
            read_tracks(tmp_path / f"none.{ending}")
    with pytest.raises(InvalidInputError, match="cannot write"):
        write_tracks(tmp_path / "none" / "a.csv", two_tracks())


@pytest.mark.parametrize("ending", ["csv", "mdf", "xml", "txt"])
def test_a_damaged_file_never_fails_in_another_way(tmp_path: Path, ending: str) -> None:
    if ending == "txt":
        write(tmp_path / "good.txt", "1,-1,10,20,30,40,0.5,-1,-1,-1\n2,3,1,1,2,2,.5\n")
    else:
        write_tracks(tmp_path / f"good.{ending}", two_tracks(width=3, height=4, scores=0.5, motility=Motility.LOW))
    good = (tmp_path / f"good.{ending}").read_bytes()
    damage = [
        b"1e300",
        b"nan",
        b"-1",
        b"inf",
        b"99999999999999999999",
        b"",
        b'"',
        b"\0",
        b"\xff",
        b"<",
        b"\r",
        b"Point",
    ]
    rng = random.Random(8)
    refused = []
    for _ in range(300):
        start = rng.randrange(len(good))
        numbers = list(re.finditer(rb"[-0-9.]+", good))
        place = rng.choice(numbers).span() if rng.random() < 0.6 else (start, start + rng.randrange(3))
        bad = tmp_path / f"bad.{ending}"
        bad.write_bytes(good[: place[0]] + rng.choice(damage) + good[place[1] :])
        try:
            read_tracks(bad, linked_only=False)
        except InvalidInputError as error:
            refused.append(str(error))
    assert len(refused) > 30
    assert not [message for message in refused if "\n" in message]


@pytest.mark.parametrize(
    "text",
    [
        "MTrackJ 1.2.0 Data File \nAssembly 1\nCluster 1\nTrack 1\nPoint 1 3.5 4 1 1 1",
        "MTrackJ 1.5.1 Data File\r\nDisplaying true true\r\nOffset 0 0 0 0 0\r\nReference 1 1 1\r\n"
        "Assembly 1 FF0000\r\nCluster 1 FF0000\r\nTrack 1 FF0000 true\r\n"
        "Point 1 9 9 1.0 1.0 1.0\r\nPoint 2 3.5 4 1.0 1.0 1.0\r\nEnd of MTrackJ Data File\r\n",
        "MTrackJ 1.4.1 Data File\nAssembly 1\nCluster 1\nTrack 5\nPoint 1 8 8 1 2 1\n"
        "Assembly 2\nCluster 1\nTrack 1\nPoint 1 3.5 4 1 1 1\n",
    ],
)
def test_dialects_of_mtrackj_are_read(tmp_path: Path, text: str) -> None:
    table = read_tracks(write(tmp_path / "a.mdf", text))
    assert (table.frames.tolist(), table.ids.tolist(), table.x.tolist(), table.y.tolist()) == ([0], [1], [3.5], [4])


def test_track_numbers_of_mtrackj_start_anew_in_each_cluster(field_data: Path) -> None:
    table = read_tracks(field_data / "mtrackj_files" / "test_mdf.mdf")
    assert [len(track) for track in table.tracks()] == [2, 3, 1, 2, 2]
    assert table.select(table.ids == 2).frames.tolist() == [0, 1, 2]


def test_exported_tracks_of_trackmate_2_are_read(field_data: Path) -> None:
    table = read_tracks(field_data / "trackmate_files" / "FakeTracks_simple_tracks_export_v2.4.1.xml")
    assert len(table.track_ids) == 4
    assert len(table.select(table.ids == 0)) == 29
    assert table.x[0] == 64.32265546876424


def test_gap_closing_tracks_of_trackmate_6_agree_with_their_table(field_data: Path) -> None:
    folder = field_data / "trackmate_files"
    table = read_tracks(folder / "FakeTracks_gapclosing_v6.0.3.xml", linked_only=False)
    assert len(table) == 134
    assert sorted(len(track) for track in table.tracks()) == sorted(
        1
        + sum(
            line.endswith(f",{track}")
            for line in (folder / "FakeTracks_gapclosing_v6.0.3_edges.csv").read_text(encoding="utf-8").splitlines()
        )
        for track in range(5)
    )


def test_splits_and_merges_cut_a_track_of_trackmate(field_data: Path) -> None:
    path = field_data / "trackmate_files" / "FakeTracks_v3.4.2.xml"
    table = read_tracks(path, linked_only=False)
    linked = table.select(table.ids != UNLINKED)
    assert len(table) == 243
    assert len(linked) == sum(int(n) for n in re.findall(r'NUMBER_SPOTS="(\d+)"', path.read_text(encoding="utf-8")))
    assert len(linked) - len(linked.track_ids) == 230 - 2 * 3 - 2 * 2, "links that are neither of a split nor a merge"


def test_spots_and_tracks_hidden_in_trackmate_8_stay_hidden(field_data: Path) -> None:
    path = field_data / "trackmate_files" / "FakeTracks_v8.0.0-SNAPSHOT.xml"
    assert len(read_tracks(path, linked_only=False)) == 106
    assert len(read_tracks(path)) == 74 + 10, "spots of the two tracks that pass the filter"
    assert read_tracks(path).calibration == Calibration(1.0, 1.0)
    assert read_tracks(path, Calibration(0.5, None)).calibration == Calibration(0.5, 1.0)


def test_silver_tracks_and_transplants_are_read(field_data: Path) -> None:
    water = read_tracks(field_data / "bacteria_water" / "bacteria_water_TL_silver_tracks.csv")
    assert len(water) == 1826
    assert 0 < water.ignored.sum() < 1000
    collagen = read_tracks(field_data / "collagen_transplant" / "collagen_agar1_transplant_tracks.csv")
    assert len(collagen) == 660
    assert np.bincount(collagen.motility).tolist() == [120, 120, 300, 120]
    for path in sorted((field_data / "memtrack_notebook").glob("rawdata_rows_*.csv")):
        assert read_tracks(path).frames.tolist()[:3] == [0, 1, 2]
