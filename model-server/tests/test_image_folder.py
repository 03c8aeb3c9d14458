# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import errno
from pathlib import Path

import cv2
import numpy as np
import pytest
import tifffile

from film_checks import FILM, HARD_NAME, check
from memtrack.errors import FilmError
from memtrack.video import open_film
from memtrack.video.folder import natural
from memtrack.video.source import COLOUR_NOTE


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


def png(path: Path) -> None:
    path.write_bytes(cv2.imencode(".png", np.zeros((4, 5), np.uint8))[1].tobytes())


def test_a_folder_named_like_an_image_is_no_frame(tmp_path: Path) -> None:
    (tmp_path / "0.png").mkdir()
    png(tmp_path / "1.png")
    check(tmp_path, np.zeros((1, 4, 5), np.uint8))


def test_what_cannot_be_read_gets_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for i in range(2):
        png(tmp_path / f"{i}.png")
    with open_film(tmp_path) as film:
        (tmp_path / "1.png").unlink()
        with pytest.raises(FilmError, match=r"cannot read .*1\.png: No such file or directory; check the file"):
            film.frame(1)
    for method, sentence in (("iterdir", "cannot read the folder"), ("exists", "cannot read")):
        with monkeypatch.context() as locked:
            locked.setattr(Path, method, refused)
            with pytest.raises(FilmError, match=f"{sentence} .*: Permission denied; check"):
                check(tmp_path, FILM)


def refused(path: Path) -> None:
    raise PermissionError(errno.EACCES, "Permission denied", str(path))


def test_frames_of_different_sizes_are_refused(tmp_path: Path) -> None:
    for i, size in enumerate((5, 6)):
        (tmp_path / f"{i}.png").write_bytes(cv2.imencode(".png", np.zeros((4, size), np.uint8))[1].tobytes())
    with open_film(tmp_path) as film, pytest.raises(FilmError, match="frame 2 has 6 x 4 pixels, frame 1 5 x 4"):
        film.frame(1)
