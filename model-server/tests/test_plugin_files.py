# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of tracks as the plug-in wrote them are read, and written alike."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from defusedxml.ElementTree import parse as parse_xml

from memtrack.film import Calibration
from memtrack.formats.trackmate_writer import FilmFile
from memtrack.tracks import Motility
from memtrack.tracks_io import read_tracks, write_tracks

PLUGIN_FILES = Path(__file__).parent / "plugin_files"
"""A film's tracks as the plug-in wrote them: one of five points, the second interpolated, and one of a single point."""


@pytest.mark.parametrize("ending", ["csv", "mdf", "xml"])
def test_files_of_the_plug_in_are_read(ending: str) -> None:
    table = read_tracks(PLUGIN_FILES / f"film.{ending}")
    assert table.frames.tolist() == [2, 3, 4, 5, 6] + [7] * (ending != "xml")
    np.testing.assert_array_equal(table.x[:5], [10.5, 12, 13.5, 15, 16.5])
    assert table.interpolated.tolist() == [i == 1 for i in range(len(table))]
    if ending != "mdf":
        np.testing.assert_array_equal(table.scores[:5], [0.75, np.nan, 0.5, 0.625, 0.5])
        assert table.boxes[1].tolist() == [-3, 7, 27, 35]
        assert table.motility[:5].tolist() == [Motility.LOW] * 5
        assert table.calibration == Calibration(0.25, 0.5)


def test_tracks_are_written_to_mtrackj_as_the_plug_in_writes_them(tmp_path: Path) -> None:
    write_tracks(tmp_path / "film.mdf", read_tracks(PLUGIN_FILES / "film.csv"))
    written, expected = (folder / "film.mdf" for folder in (tmp_path, PLUGIN_FILES))
    assert written.read_bytes().split(b"\r\n") == expected.read_bytes().replace(b"\r", b"").split(b"\n")


def test_tracks_are_written_to_trackmate_as_the_plug_in_writes_them(tmp_path: Path) -> None:
    """But for what the plug-in alone knows: level, contrast, error, the stage's drift, what it measures of a track."""
    film = FilmFile(Path("/films/film.tif"), 100, 80, 9)
    write_tracks(tmp_path / "film.xml", read_tracks(PLUGIN_FILES / "film.csv"), film=film)
    alone = ("LEVEL", "CONTRAST", "POSITION_ERROR", "DRIFT_X", "DRIFT_Y", "PEAK_DIFFUSIVITY", "MEAN_SPEED", "LAG_SPEED")
    ours, theirs = (list(parse_xml(f / "film.xml").getroot().iter()) for f in (tmp_path, PLUGIN_FILES))
    theirs = [e for e in theirs if e.get("feature", "").removeprefix("MEMTRACK_") not in alone]
    assert [e.tag for e in ours] == [e.tag for e in theirs]
    for our, their in zip(ours, theirs, strict=True):
        if our.tag == "ImageData":
            our.attrib.pop("folder"), their.attrib.pop("folder")
        wanted = {k: v for k, v in their.attrib.items() if k.removeprefix("MEMTRACK_") not in alone}
        assert {k: plain(v) for k, v in our.attrib.items()} == {k: plain(v) for k, v in wanted.items()}
        assert (our.text or "").strip() == (their.text or "").strip()


def plain(value: str) -> str | float:
    """A number where it is one, as accurate as tables are."""
    try:
        return round(float(value), 5)
    except ValueError:
        return value
