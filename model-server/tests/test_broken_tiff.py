# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile

from film_checks import FILM, check, frames
from memtrack.errors import FilmError
from memtrack.video import open_film
from memtrack.video.tiff import _decoded_by_opencv


def test_a_page_that_cannot_be_decoded_is_refused_with_its_frame(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, compression="zlib", photometric="minisblack")
    with tifffile.TiffFile(path) as file:
        place = file.pages[3].dataoffsets[0]
    content = bytearray(path.read_bytes())
    content[place : place + 8] = b"\xff" * 8
    path.write_bytes(content)
    with open_film(path) as film, pytest.raises(FilmError, match=r"frame 4 of film\.tif cannot be read as TIFF"):
        frames(film)


def test_an_unknown_compression_is_refused_in_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM[0], compression="zlib")
    with tifffile.TiffFile(path, mode="r+") as file:
        file.pages.first.tags["Compression"].overwrite(tifffile.COMPRESSION.LERC)
    with (
        pytest.raises(FilmError, match=r"frame 1 of film\.tif cannot be read .*LERC.*; save the film again"),
        open_film(path),
    ):
        pass


@pytest.mark.parametrize(
    "options",
    [{"imagej": True, "metadata": {"axes": "TYX"}}, {"ome": True}, {}, {"compression": "zlib"}],
    ids=["imagej", "ome", "plain", "zlib"],
)
def test_a_tiff_that_broke_off_is_refused_or_lacks_no_frame(tmp_path: Path, options: dict[str, Any]) -> None:
    path = tmp_path / "film.tif"
    film = np.repeat(np.repeat(FILM, 6, axis=1), 6, axis=2)
    tifffile.imwrite(path, film, photometric="minisblack", **options)
    content = path.read_bytes()
    sentences = []
    for part in range(1, 40):
        path.write_bytes(content[: len(content) * part // 40])
        try:
            check(path, film)
        except FilmError as error:
            sentences.append(str(error))
    assert len(sentences) > 15
    whole = re.compile(r"film\.tif holds \d+ of \d+ frames|film\.tif breaks off after \d+ frame|cannot be read as TIFF")
    assert all(whole.search(sentence) for sentence in sentences)


def test_the_frames_an_imagej_film_promises_are_counted(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM[0], description="ImageJ=1.54p\nimages=6\nframes=6\n", metadata=None)
    with (
        pytest.raises(FilmError, match=r"film\.tif holds 1 of 6 frames, the rest is lost; copy it again"),
        open_film(path),
    ):
        pass


def test_pages_that_promise_nothing_must_end_where_the_last_one_says_so(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    with tifffile.TiffWriter(path) as writer:
        for frame in FILM:
            writer.write(frame, metadata=None, contiguous=False)
    check(path, FILM)
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(FilmError, match=r"film\.tif breaks off after [5-7] frame\(s\); copy it again"), open_film(path):
        pass


def test_opencv_does_not_decode_a_page_that_is_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, compression="zlib", photometric="minisblack")
    path.write_bytes(path.read_bytes()[:-1])
    with tifffile.TiffFile(path) as file, pytest.raises(ValueError, match="the file ends within it"):
        _decoded_by_opencv(file, file.pages[-1])
