# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
import shutil
import tempfile
import threading
from pathlib import Path

import numpy as np
import pytest

from memtrack.errors import ResourceLimitError
from memtrack.film import Calibration
from memtrack.spool import MARGIN_BYTES, FilmGeometry, SpooledFilm, SpoolFolder, default_folder, megabytes


def geometry(film: np.ndarray) -> FilmGeometry:
    frames, height, width = film.shape
    return FilmGeometry(width, height, frames, film.dtype)


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_frames_come_back_as_they_went_in(tmp_path: Path, dtype: str) -> None:
    film = np.random.default_rng(0).integers(0, 255, (5, 7, 11)).astype(dtype)
    calibration = Calibration(0.2475, 1 / 60)
    with SpoolFolder(tmp_path).open(geometry(film), calibration) as spooled:
        data = film.tobytes()
        for start in range(0, len(data), 13):
            spooled.append(data[start : start + 13])
        assert (spooled.frame_count, spooled.height, spooled.width) == (5, 7, 11)
        assert spooled.calibration == calibration
        assert spooled.missing_bytes == 0
        for i in (3, 0, 4, 4, 1, 2):
            frame = spooled.frame(i)
            assert frame.dtype == film.dtype
            np.testing.assert_array_equal(frame, film[i])


def test_a_frame_that_is_not_there_yet_cannot_be_read(tmp_path: Path) -> None:
    film = np.zeros((2, 3, 4), np.uint8)
    with SpoolFolder(tmp_path).open(geometry(film), Calibration()) as spooled:
        spooled.append(bytes(12 + 11))
        assert spooled.frame(0).shape == (3, 4)
        for index in (1, 2, -1):
            with pytest.raises(IndexError, match=f"frame {index} of 2 is not in the spool"):
                spooled.frame(index)


def test_threads_read_and_write_at_the_same_time(tmp_path: Path) -> None:
    film = np.random.default_rng(1).integers(0, 255, (200, 20, 30)).astype(np.uint8)
    with SpoolFolder(tmp_path).open(geometry(film), Calibration()) as spooled:
        written = threading.Semaphore(0)
        wrong: list[int] = []

        def read() -> None:
            for i in range(200):
                written.acquire()
                if not np.array_equal(spooled.frame(i), film[i]):
                    wrong.append(i)

        reader = threading.Thread(target=read)
        reader.start()
        for frame in film:
            spooled.append(frame.tobytes())
            written.release()
        reader.join()
        assert wrong == []


def test_nothing_is_left_after_the_block_whatever_happened_in_it(tmp_path: Path) -> None:
    folder = SpoolFolder(tmp_path)
    free = folder.free_bytes()
    films = folder.open(FilmGeometry(1000, 1000, 5, np.dtype("u1")), Calibration())
    with pytest.raises(ResourceLimitError), films as spooled:
        _fail_after(spooled, 5_000_000)
    assert list(tmp_path.iterdir()) == []
    assert free - folder.free_bytes() < 4_000_000


def _fail_after(spooled: SpooledFilm, size: int) -> None:
    spooled.append(bytes(size))
    raise ResourceLimitError("in the middle of a film")


def test_space_promised_to_one_film_is_not_promised_to_another(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    usage = shutil.disk_usage(tmp_path)._replace(free=MARGIN_BYTES + 1000)
    monkeypatch.setattr(shutil, "disk_usage", lambda _path: usage)
    folder = SpoolFolder(tmp_path)
    big, small = (FilmGeometry(n, 1, 1, np.dtype("u1")) for n in (900, 101))
    with folder.open(big, Calibration()):
        assert folder.free_bytes() == 100
        with pytest.raises(ResourceLimitError, match=r"the film needs 0\.0 MB of disk, but .* has 0\.0 MB to spare"):
            folder.open(small, Calibration()).__enter__()
    with folder.open(small, Calibration()):
        assert folder.free_bytes() == 899


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a disk that is always full")
def test_a_full_disk_is_said_in_one_sentence(tmp_path: Path) -> None:
    with SpoolFolder(tmp_path).open(FilmGeometry(10, 10, 1, np.dtype("u1")), Calibration()) as spooled:
        spooled._file.close()
        spooled._file = open("/dev/full", "r+b", buffering=0)  # noqa: SIM115
        with pytest.raises(ResourceLimitError, match=r"could not be spooled after 0 of 100 bytes \(No space left"):
            spooled.append(bytes(100))


def test_a_folder_that_is_not_there_is_said(tmp_path: Path) -> None:
    with pytest.raises(ResourceLimitError, match=r"cannot spool the film in .*missing: No such file"):
        SpooledFilm(FilmGeometry(1, 1, 1, np.dtype("u1")), Calibration(), tmp_path / "missing")


@pytest.mark.skipif(not os.access("/var/tmp", os.W_OK), reason="only Unix has a temporary folder that lasts")
def test_spools_lie_on_a_disk_unless_the_user_chose_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("TMPDIR", "TEMP", "TMP"):
        monkeypatch.delenv(name, raising=False)
    assert default_folder() == Path("/var/tmp")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    assert default_folder() == tmp_path


def test_bytes_for_people() -> None:
    assert [megabytes(n) for n in (0, 324_720, 999_000_000, 2_338_000_000)] == [
        "0.0 MB",
        "0.3 MB",
        "999.0 MB",
        "2.3 GB",
    ]
