# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tifffile

from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.video import OpenedFilm, open_film
from memtrack.video.folder import natural
from memtrack.video.source import COLOUR_NOTE, INTEGER_NOTE, grey
from memtrack.video.tiff import _decoded_by_opencv

FILM = np.random.default_rng(0).integers(0, 250, (12, 9, 14)).astype(np.uint8)
HARD_NAME = "Film [1] für 细菌 ü"


def frames(film: OpenedFilm) -> np.ndarray:
    read = np.stack([film.frame(i) for i in range(film.frame_count)])
    assert read.shape == (film.frame_count, film.height, film.width)
    return read


def check(path: Path, expected: np.ndarray, notes: tuple[str, ...] = ()) -> Calibration:
    """Reads the film at `path`; its frames must be `expected`, in value and type."""
    with open_film(path) as film:
        read = frames(film)
        np.testing.assert_array_equal(read, expected)
        assert read.dtype == expected.dtype
        assert film.notes == notes
        # Any order, more than once.
        np.testing.assert_array_equal(film.frame(film.frame_count - 1), expected[-1])
        np.testing.assert_array_equal(film.frame(0), expected[0])
        return film.calibration


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


def test_a_page_that_cannot_be_decoded_is_refused_with_its_frame(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, compression="zlib", photometric="minisblack")
    with tifffile.TiffFile(path) as file:
        place = file.pages[3].dataoffsets[0]
    content = bytearray(path.read_bytes())
    content[place : place + 8] = b"\xff" * 8
    path.write_bytes(content)
    with open_film(path) as film, pytest.raises(FilmError, match=r"frame 3 of film\.tif cannot be read as TIFF"):
        frames(film)


def test_an_unknown_compression_is_refused_in_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM[0], compression="zlib")
    with tifffile.TiffFile(path, mode="r+") as file:
        file.pages.first.tags["Compression"].overwrite(tifffile.COMPRESSION.LERC)
    with (
        pytest.raises(FilmError, match=r"frame 0 of film\.tif cannot be read .*LERC.*; save the film again"),
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


@pytest.mark.parametrize(("unit", "factor"), [("um", 1), ("micron", 1), ("\\u00B5m", 1), ("nm", 1e-3), ("mm", 1e3)])
def test_imagej_tiff_tells_pixel_size_and_frame_interval(tmp_path: Path, unit: str, factor: float) -> None:
    path = tmp_path / "film.tif"
    tags = {"axes": "TYX", "unit": unit, "finterval": 0.5}
    tifffile.imwrite(path, FILM, imagej=True, metadata=tags, resolution=(4.0, 4.0))
    calibration = check(path, FILM)
    assert calibration.pixel_size_um == pytest.approx(0.25 * factor)
    assert calibration.frame_interval_seconds == 0.5


@pytest.mark.parametrize("unit", ["pixel", "inch"])
def test_imagej_tiff_in_pixels_or_in_inches_of_a_screen_tells_no_size(tmp_path: Path, unit: str) -> None:
    path = tmp_path / "film.tif"
    tags = {"axes": "TYX", "unit": unit, "fps": 25.0}
    tifffile.imwrite(path, FILM, imagej=True, metadata=tags, resolution=(72.0, 72.0))
    assert check(path, FILM) == Calibration(None, 1 / 25)


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


def test_ome_tiff_tells_pixel_size_and_time(tmp_path: Path) -> None:
    path = tmp_path / "film.ome.tif"
    size = {"PhysicalSizeX": 247.5, "PhysicalSizeXUnit": "nm", "TimeIncrement": 20.0, "TimeIncrementUnit": "ms"}
    tifffile.imwrite(path, FILM, ome=True, metadata={"axes": "TYX", **size})
    calibration = check(path, FILM)
    assert calibration.pixel_size_um == pytest.approx(0.2475)
    assert calibration.frame_interval_seconds == pytest.approx(0.02)


def test_a_given_calibration_goes_before_the_files(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(
        path, FILM, imagej=True, metadata={"axes": "TYX", "unit": "um", "finterval": 0.5}, resolution=(4, 4)
    )
    with open_film(path, Calibration(pixel_size_um=0.1)) as film:
        assert film.calibration == Calibration(0.1, 0.5)


def test_slices_are_taken_as_time_with_a_note(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, imagej=True, metadata={"axes": "ZYX"})
    check(path, FILM, ("The 12 slices of film.tif are taken as time points.",))


@pytest.mark.parametrize(
    ("axes", "found"), [("TZYX", "3 time points, 4 slices"), ("TCYX", "3 time points, 4 channels")]
)
def test_more_than_time_is_refused_with_what_was_found(tmp_path: Path, axes: str, found: str) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM.reshape(3, 4, 9, 14), imagej=True, metadata={"axes": axes})
    with pytest.raises(FilmError, match=f"film.tif has {found}, but a film is one plane a time point"), open_film(path):
        pass


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


@pytest.mark.parametrize("depth", ["uint8", "uint16"])
def test_a_folder_of_png_in_natural_order(tmp_path: Path, depth: str) -> None:
    folder = tmp_path / HARD_NAME
    folder.mkdir()
    film = FILM.astype(depth) * (257 if depth == "uint16" else 1)
    for i, frame in enumerate(film.astype(depth)):
        (folder / f"bild {i}.png").write_bytes(cv2.imencode(".png", frame)[1].tobytes())
    (folder / "notes.txt").write_text("not a frame", encoding="utf-8")
    (folder / "._bild 0.png").write_bytes(b"left by macOS")
    check(folder, film.astype(depth))


@pytest.mark.parametrize(("red", "green", "blue"), [(200, 20, 10), (201, 101, 50)])
def test_a_png_with_colours_and_alpha_is_weighted_as_one_without(
    tmp_path: Path, red: int, green: int, blue: int
) -> None:
    bgra = np.full((4, 5, 4), [blue, green, red, 255], np.uint8)
    for name, image in (("with.png", bgra), ("without.png", bgra[..., :3])):
        (tmp_path / name).write_bytes(cv2.imencode(".png", np.ascontiguousarray(image))[1].tobytes())
    expected = round(0.299 * red + 0.587 * green + 0.114 * blue)
    check(tmp_path, np.full((2, 4, 5), expected, np.uint8), (COLOUR_NOTE,))


def test_colours_of_floating_point_are_not_rounded() -> None:
    colour = np.array([[[0.2, 0.4, 0.1]]], np.float32)
    np.testing.assert_allclose(grey(colour), [[0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.1]], rtol=1e-6)


def test_names_with_numbers_sort_by_their_value() -> None:
    names = ["f10.png", "F2.png", "f1.png", "t2f1.png", "t10f1.png", "10.png", "9.png"]
    ordered = ["9.png", "10.png", "f1.png", "F2.png", "f10.png", "t2f1.png", "t10f1.png"]
    assert sorted(names, key=natural) == ordered


def test_a_folder_of_single_tiffs(tmp_path: Path) -> None:
    for i, frame in enumerate(FILM):
        tifffile.imwrite(tmp_path / f"frame_{i:03}.tif", frame)
    check(tmp_path, FILM)


def test_a_folder_of_films_is_refused(tmp_path: Path) -> None:
    tifffile.imwrite(tmp_path / "a.tif", FILM, photometric="minisblack")
    with pytest.raises(FilmError, match=r"a\.tif holds 12 images, but a folder is read as one image a file"):
        check(tmp_path, FILM)


def write_avi(path: Path, film: np.ndarray) -> None:
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"FFV1"), 25.0, film.shape[:0:-1], isColor=False)
    assert writer.isOpened()
    for frame in film:
        writer.write(frame)
    writer.release()


def test_an_avi_is_read_without_loss_or_shift(tmp_path: Path) -> None:
    path = tmp_path / f"{HARD_NAME}.avi"
    film = np.repeat(np.repeat(FILM, 4, axis=1), 4, axis=2)
    write_avi(path, film)
    assert check(path, film).frame_interval_seconds == pytest.approx(1 / 25)


def test_an_avi_that_broke_off_is_refused_and_one_that_lost_a_frame_gets_a_note(tmp_path: Path) -> None:
    path = tmp_path / "film.avi"
    film = np.random.default_rng(0).integers(0, 250, (12, 48, 64)).astype(np.uint8)
    write_avi(path, film)
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(FilmError, match=r"film\.avi holds [3-6] of 12 frames, the rest is lost; copy"), open_film(path):
        pass
    path.write_bytes(content[: int(len(content) * 0.96)])
    check(path, film[:11], ("film.avi holds 11 frames, its header says 12.",))


def _text(path: Path) -> Path:
    path.write_text("not a film", encoding="utf-8")
    return path


def test_what_is_no_film_gets_one_sentence(tmp_path: Path) -> None:
    def refusal(path: Path) -> str:
        with pytest.raises(FilmError) as refused, open_film(path) as film:
            frames(film)
        return str(refused.value)

    assert "there is no film" in refusal(tmp_path / "missing.tif")
    assert "film.czi is no film this program reads" in refusal(_text(tmp_path / "film.czi"))
    assert "film.tif cannot be read as TIFF" in refusal(_text(tmp_path / "film.tif"))
    assert "film.avi cannot be decoded as video" in refusal(_text(tmp_path / "film.avi"))
    empty = tmp_path / "empty"
    empty.mkdir()
    assert "has no images" in refusal(empty)
    (empty / "1.png").write_bytes(b"")
    assert "1.png cannot be decoded as an image" in refusal(empty)
    (empty / "2.tif").write_bytes(b"")
    assert r"has images of several kinds (.png, .tif)" in refusal(empty)


def test_frames_of_different_sizes_are_refused(tmp_path: Path) -> None:
    for i, size in enumerate((5, 6)):
        (tmp_path / f"{i}.png").write_bytes(cv2.imencode(".png", np.zeros((4, size), np.uint8))[1].tobytes())
    with open_film(tmp_path) as film, pytest.raises(FilmError, match="frame 1 has 6 x 4 pixels, frame 0 5 x 4"):
        film.frame(1)


def test_a_black_and_white_image_is_grey() -> None:
    np.testing.assert_array_equal(grey(np.array([[True, False]])), np.array([[255, 0]], np.uint8))
    with pytest.raises(FilmError, match="are not grey levels"):
        grey(np.zeros((2, 2), np.complex64))
