# SPDX-License-Identifier: GPL-3.0-or-later
"""Dense optical flow between two frames, as magnitude in pixels a frame."""

from __future__ import annotations

import cv2
import numpy as np
from jaxtyping import Float32

Image = Float32[np.ndarray, "h w"]


def lucas_kanade_magnitude(previous: Image, current: Image, sigma: float = 3.0, floor: float = 4.0) -> Image:
    """Lucas and Kanade's least-squares flow of a Gaussian window of width `sigma`, at every pixel (paper, channel 2).

    `floor` (grey levels squared) is added to the structure tensor's diagonal: no flow where there is no texture.
    """
    mean = 0.5 * (previous + current)
    gx = cv2.Scharr(mean, cv2.CV_32F, 1, 0, scale=1 / 32)
    gy = cv2.Scharr(mean, cv2.CV_32F, 0, 1, scale=1 / 32)
    change = previous - current
    a, b, c, u, v = (
        cv2.GaussianBlur(product, (0, 0), sigma) for product in (gx * gx, gx * gy, gy * gy, gx * change, gy * change)
    )
    a, c = a + floor, c + floor
    determinant = a * c - b * b
    magnitude: Image = cv2.magnitude((c * u - b * v) / determinant, (a * v - b * u) / determinant)
    return magnitude


def farneback_magnitude(previous: Image, current: Image) -> Image:
    """Farneback's flow with the MEMTrack authors' parameters (their data preparation: 0.5, 2, 18, 3, 5, 1.2, 0)."""
    before, after = (np.clip(frame, 0, 255).astype(np.uint8) for frame in (previous, current))
    flow = cv2.calcOpticalFlowFarneback(before, after, None, 0.5, 2, 18, 3, 5, 1.2, 0)  # type: ignore[call-overload]
    magnitude: Image = cv2.magnitude(flow[..., 0], flow[..., 1])
    return magnitude
