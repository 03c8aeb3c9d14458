# SPDX-License-Identifier: GPL-3.0-or-later
"""What a reader of one file format gives, and the turning of images into grey frames."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import cv2
import numpy as np
from jaxtyping import Shaped

from memtrack.errors import FilmError
from memtrack.film import Calibration

Frame = Shaped[np.ndarray, "height width"]

COLOUR_NOTE = "The film is in colour; it was turned grey by its brightness."
INTEGER_NOTE = "The film's samples were turned into 32-bit floating point numbers."


@dataclass(frozen=True, slots=True)
class Source:
    """Frames of one file: `read(i)` gives frame i as it is stored, grey or with its colours last."""

    frame_count: int
    height: int
    width: int
    read: Callable[[int], Shaped[np.ndarray, "..."]]
    calibration: Calibration = field(default_factory=Calibration)
    notes: tuple[str, ...] = ()

    def frame(self, index: int) -> Frame:
        """Frame `index`, from 0, grey, in uint8, uint16 or float32."""
        if not 0 <= index < self.frame_count:
            raise IndexError(f"frame {index} of {self.frame_count}")
        frame = grey(self.read(index))
        if frame.shape != (self.height, self.width):
            raise FilmError(
                f"frame {index + 1} has {frame.shape[1]} x {frame.shape[0]} pixels, frame 1 {self.width} x "
                f"{self.height}; all frames of a film need one size"
            )
        return frame


def grey(image: Shaped[np.ndarray, "..."]) -> Frame:
    """`image` in grey, in the nearest of uint8, uint16 and float32; colours are red green blue, or grey and alpha.

    Colours that are all the same are a grey image; others are weighted by their brightness (ITU-R BT.601).
    """
    if image.ndim == 3 and image.shape[2] in (3, 4):
        rgb = image[..., :3]
        same = (rgb == rgb[..., :1]).all()
        brightness = rgb[..., 0] if same else rgb @ np.array([0.299, 0.587, 0.114])
        image = (np.rint(brightness) if image.dtype.kind in "iu" else brightness).astype(image.dtype)
    elif image.ndim == 3 and image.shape[2] in (1, 2):
        image = image[..., 0]
    if image.ndim != 2:
        raise FilmError(f"an image of the shape {image.shape} is no frame; save the film as a stack of grey frames")
    if image.dtype == np.bool_:
        return image.astype(np.uint8) * np.uint8(255)
    if image.dtype in (np.uint8, np.uint16):
        return np.ascontiguousarray(image, image.dtype.newbyteorder("="))
    if image.dtype.kind in "iuf":
        return np.ascontiguousarray(image, np.float32)
    raise FilmError(f"samples of the type {image.dtype} are not grey levels; save the film as 8, 16 or 32 bit")


def notes_on(image: Shaped[np.ndarray, "..."]) -> tuple[str, ...]:
    """What `grey` changes in `image`."""
    notes = []
    if image.ndim == 3 and image.shape[2] >= 3 and not (image[..., :3] == image[..., :1]).all():
        notes.append(COLOUR_NOTE)
    if image.dtype.kind in "iuf" and image.dtype not in (np.uint8, np.uint16, np.float32):
        notes.append(INTEGER_NOTE)
    return tuple(notes)


def decode(content: bytes, name: str) -> Shaped[np.ndarray, "..."]:
    """The image in the bytes of a PNG, JPEG or BMP file.

    Raises:
        FilmError: it cannot be decoded.
    """
    image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED) if content else None
    if image is None:
        raise FilmError(f"{name} cannot be decoded as an image; export the frames again")
    return red_first(image)


def red_first(image: Shaped[np.ndarray, "..."]) -> Shaped[np.ndarray, "..."]:
    """An image as OpenCV gives it, blue first, with its red first."""
    return image[..., [2, 1, 0, 3][: image.shape[2]]] if image.ndim == 3 and image.shape[2] >= 3 else image
