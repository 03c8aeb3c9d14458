# SPDX-License-Identifier: GPL-3.0-or-later
"""Channels of 8 bits: how signed values are squeezed into them, finely near zero and never saturated."""

from __future__ import annotations

import cv2
import numpy as np
from jaxtyping import Float32, UInt8

Image = Float32[np.ndarray, "h w"]
Channel = UInt8[np.ndarray, "h w"]

NEUTRAL = 128
KNEE = 10.0
"""Signed channels hold 128 + 127 v / (|v| + KNEE): 12 steps to a noise sd near zero, never saturated."""
SHADING_PX, SHADING_SHRINK = 32.0, 8
"""Width (sigma) of the Gaussian windows that tell shading, at this fraction of the size."""


def signed(values: Image) -> Channel:
    """Signed values squeezed into 8 bits around `NEUTRAL`."""
    size = np.abs(values)
    size += np.float32(KNEE)
    np.divide(values, size, out=size)
    size *= np.float32(127)
    size += np.float32(NEUTRAL + 0.5)
    return as_bytes(size)


def as_bytes(values: np.ndarray) -> Channel:
    """Values in [0, 256), cut to whole numbers."""
    squeezed: np.ndarray = values.astype(np.uint8)
    return squeezed


def shading_of(image: Image) -> Image:
    """`image` without anything as small as bacteria or grain."""
    return coarse(image, SHADING_PX, SHADING_SHRINK)


def coarse(image: Image, reach_px: float, shrink: int) -> Image:
    """`image` through Gaussian windows of a width (sigma) of `reach_px`, averaged at 1/`shrink` of the size."""
    h, w = image.shape
    small = cv2.resize(image, (max(1, w // shrink), max(1, h // shrink)), interpolation=cv2.INTER_AREA)
    smooth = cv2.GaussianBlur(small, (0, 0), reach_px / shrink)
    return cv2.resize(smooth, (w, h), interpolation=cv2.INTER_LINEAR)
