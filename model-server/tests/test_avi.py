# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from film_checks import FILM, HARD_NAME, check
from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.video import open_film

PLAYBACK = (
    "The frame interval, 0.04 s, is taken from the film's playback rate; if it was recorded at another rate, give its "
    "interval."
)


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
    assert check(path, film, (PLAYBACK,)).frame_interval_seconds == pytest.approx(1 / 25)


def test_an_interval_that_is_given_goes_before_an_avis_playback_rate_and_needs_no_note(tmp_path: Path) -> None:
    path = tmp_path / "film.avi"
    write_avi(path, np.repeat(np.repeat(FILM, 4, axis=1), 4, axis=2))
    with open_film(path, Calibration(frame_interval_seconds=0.1)) as film:
        assert film.calibration.frame_interval_seconds == 0.1
        assert not film.notes


def test_an_avi_that_broke_off_is_refused_and_one_that_lost_a_frame_gets_a_note(tmp_path: Path) -> None:
    path = tmp_path / "film.avi"
    film = np.random.default_rng(0).integers(0, 250, (12, 48, 64)).astype(np.uint8)
    write_avi(path, film)
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(FilmError, match=r"film\.avi holds [3-6] of 12 frames, the rest is lost; copy"), open_film(path):
        pass
    path.write_bytes(content[: int(len(content) * 0.96)])
    check(path, film[:11], ("film.avi holds 11 frames, its header says 12.", PLAYBACK))
