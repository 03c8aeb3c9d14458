# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tifffile

from film_checks import FILM, HARD_NAME, check
from memtrack.film import Calibration
from memtrack.video.source import COLOUR_NOTE, INTEGER_NOTE
from memtrack.video.tiff import _decoded_by_opencv


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
@pytest.mark.parametrize("compression", [None, "zlib"])
@pytest.mark.parametrize("byteorder", ["<", ">"])
def test_multi_page_tiff(tmp_path: Path, dtype: str, compression: str | None, byteorder: Any) -> None:
    path = tmp_path / f"{HARD_NAME}.tif"
    film = FILM.astype(dtype)
    tifffile.imwrite(path, film, compression=compression, byteorder=byteorder, photometric="minisblack")
    assert check(path, film) == Calibration()


def encoded(film: np.ndarray, compression: int) -> bytes:
    """A multi-page TIFF as libtiff writes it."""
    flags = [cv2.IMWRITE_TIFF_COMPRESSION, compression]
    return cv2.imencodemulti(".tiff", list(film), flags)[1].tobytes()


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_lzw_tiffs_are_read_as_a_film_and_as_a_folder(tmp_path: Path, dtype: str) -> None:
    path = tmp_path / f"{HARD_NAME}.tif"
    film = FILM.astype(dtype)
    path.write_bytes(encoded(film, cv2.IMWRITE_TIFF_COMPRESSION_LZW))
    check(path, film)
    folder = tmp_path / "folder"
    folder.mkdir()
    for i, frame in enumerate(film):
        (folder / f"{i}.tif").write_bytes(encoded(frame[None], cv2.IMWRITE_TIFF_COMPRESSION_LZW))
    check(folder, film)


@pytest.mark.parametrize("bigtiff", [False, True])
@pytest.mark.parametrize("byteorder", ["<", ">"])
def test_opencv_decodes_the_page_it_is_asked_for(tmp_path: Path, bigtiff: bool, byteorder: Any) -> None:
    path = tmp_path / f"{HARD_NAME}.tif"
    film = FILM.astype(np.uint16) * 200
    tifffile.imwrite(path, film, compression="zlib", photometric="minisblack", bigtiff=bigtiff, byteorder=byteorder)
    with tifffile.TiffFile(path) as file:
        for i in (7, 0, 11):
            np.testing.assert_array_equal(_decoded_by_opencv(file, file.pages[i]), film[i])


def test_a_coloured_lzw_tiff_has_its_red_first(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    blue_green_red = np.full((2, 4, 5, 3), [10, 20, 200], np.uint8)
    path.write_bytes(encoded(blue_green_red, cv2.IMWRITE_TIFF_COMPRESSION_LZW))
    check(path, np.full((2, 4, 5), 73, np.uint8), (COLOUR_NOTE,))


def test_imagej_tiff_beyond_4_gb_has_one_page_and_all_frames(tmp_path: Path) -> None:
    """ImageJ writes one image file directory and the frames one after the other; here without the 4 GB."""
    path = tmp_path / "film.tif"
    description = f"ImageJ=1.54p\nimages={len(FILM)}\nframes={len(FILM)}\nhyperstack=true\n"
    tifffile.imwrite(path, FILM[0], description=description, metadata=None, byteorder=">")
    with tifffile.TiffFile(path) as file:
        start = file.pages.first.dataoffsets[0]
    content = path.read_bytes()
    assert start + FILM[0].size == len(content), "the frames must follow the first one"
    path.write_bytes(content + FILM[1:].tobytes())
    check(path, FILM)


def test_one_image_is_a_film_of_one_frame(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM[0])
    check(path, FILM[:1])


def test_colour_is_turned_grey_with_a_note(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    colour = np.stack([FILM, FILM // 2, FILM // 3], axis=-1)
    tifffile.imwrite(path, colour, photometric="rgb")
    expected = np.rint(colour @ np.array([0.299, 0.587, 0.114])).astype(np.uint8)
    check(path, expected, (COLOUR_NOTE,))
    tifffile.imwrite(path, np.stack([FILM] * 3, axis=-1), photometric="rgb")
    check(path, FILM)


def test_other_integers_become_float_with_a_note(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    film = FILM.astype(np.int32) - 100
    tifffile.imwrite(path, film, photometric="minisblack")
    check(path, film.astype(np.float32), (INTEGER_NOTE,))
