# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

import pytest

from film_checks import frames
from memtrack.errors import FilmError
from memtrack.video import open_film


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
