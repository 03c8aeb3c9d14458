# SPDX-License-Identifier: GPL-3.0-or-later
"""A running clock and a scale bar, burnt into frames as recording software does: they change, and are no cells."""

from __future__ import annotations

import cv2
import numpy as np

FONTS = (cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_HERSHEY_PLAIN, cv2.FONT_HERSHEY_COMPLEX_SMALL)


def burn_in(frames: np.ndarray, interval_seconds: float, rng: np.random.Generator) -> None:
    """Writes into `frames` [frame, y, x] of 8 or 16 bits, in place."""
    _, height, width = frames.shape
    brightest = int(frames.max())
    colour = int(rng.choice([brightest, 255 if frames.dtype == np.uint8 else 65535, 0]))
    font, size, thick = int(rng.choice(FONTS)), float(rng.uniform(0.35, 0.9)), int(rng.integers(1, 3))
    left = rng.integers(2, max(3, width // 2), 2).tolist()
    clock = left[0], int(rng.choice([rng.uniform(12, 30), height - rng.uniform(4, 20)]))
    bar = left[1], int(rng.choice([rng.uniform(4, 20), height - rng.uniform(24, 40)]))
    start, counted = float(rng.choice([0.0, rng.uniform(0, 500)])), bool(rng.random() < 0.3)
    length = int(rng.uniform(40, 120))
    ink = np.zeros((height, width), np.uint8)  # OpenCV draws in 8 bits only
    for i, frame in enumerate(frames):
        text = f"frame {int(start) + i}" if counted else f"{start + i * interval_seconds:.2f} s"
        ink[...] = 0
        cv2.putText(ink, text, clock, font, size, 255, thick, cv2.LINE_AA)
        cv2.line(ink, bar, (bar[0] + length, bar[1]), 255, thick + 1)
        frame[...] = np.rint(frame + (colour - frame.astype(np.float32)) * (ink / np.float32(255)))
