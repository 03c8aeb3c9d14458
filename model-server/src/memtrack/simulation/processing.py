# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens to frames after the camera: the background is subtracted from them, or they are packed as a video."""

from __future__ import annotations

import tempfile
from pathlib import Path

import cv2
import numpy as np
from jaxtyping import Shaped, UInt8

from memtrack.errors import FilmError

Frames = Shaped[np.ndarray, "frame h w"]


def without_background(frames: Frames, sign: int, rng: np.random.Generator) -> Frames:
    """`frames` less their mean or median, as is often done before tracking: around a middle grey, their size alone, or,
    where all bacteria are brighter (`sign` 1) or darker (-1) than the medium, cut off on the other side."""
    still = frames.mean(axis=0) if rng.random() < 0.5 else np.median(frames, axis=0)
    difference = (frames - still) * (sign or 1)
    most = int(np.iinfo(frames.dtype).max)
    kind = rng.choice(["centred", "size", "cut" if sign else "centred"], p=[0.4, 0.2, 0.4])
    if kind == "centred":
        difference += 128 if most == 255 else 2048
    elif kind == "size":
        difference = np.abs(difference)
    return np.clip(np.rint(difference), 0, most).astype(frames.dtype)


def through_video(frames: UInt8[np.ndarray, "frame h w"]) -> UInt8[np.ndarray, "frame h w"]:
    """`frames` as they come back from an MPEG-4 file, which keeps little of what is faint and none of the noise.

    Raises:
        FilmError: OpenCV was built without the encoder.
    """
    _, h, w = frames.shape
    even = np.pad(frames, ((0, 0), (0, h % 2), (0, w % 2)), mode="edge")
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "film.avi")
        writer = cv2.VideoWriter(path, cv2.VideoWriter.fourcc(*"XVID"), 25, (even.shape[2], even.shape[1]))
        if not writer.isOpened():
            raise FilmError("this OpenCV cannot write MPEG-4 videos: install opencv-python-headless from its wheel")
        for frame in even:
            writer.write(cv2.cvtColor(frame, cv2.COLOR_GRAY2BGR))
        writer.release()
        reader = cv2.VideoCapture(path)
        read = [cv2.cvtColor(reader.read()[1], cv2.COLOR_BGR2GRAY)[:h, :w] for _ in frames]
        reader.release()
    return np.stack(read)
