# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands still in the picture while the scene drifts: dust and scratches near the camera, hot pixels.

Seen from the scene it moves, like bacteria that all swim one way. So it is told from the scene and taken out.
"""

from __future__ import annotations

import cv2
import numpy as np
from jaxtyping import Float32

from memtrack.background import Background, split_drift
from memtrack.film import Film
from memtrack.resampling import read_shifted
from memtrack.stabilisation import FilmMotion

Image = Float32[np.ndarray, "h w"]

LEAST_DRIFT_PX = 12.0
"""A scene must drift by more than a bacterium is long, or one that rests in it covers the same pixel nearly always."""
SAMPLES = 32
SIGNIFICANT = 8.0
"""Standard errors above which a pixel belongs to the pattern; one that is covered in two of three frames has that."""
STRONG = 2.0
"""The film's noise times this must be exceeded somewhere, or the pattern is not worth the work."""


def fixed_pattern(film: Film, motion: FilmMotion, background: Background, frames: range) -> Image | None:
    """Grey levels that the camera adds to every frame, 0 where none are sure; None where nothing strong is found.

    The mean, over some of the frames, of what is left of a frame without the scene. Where the scene drifts by less than
    the size of a speck, some of the speck is in the background.

    Args:
        film, motion: frames as the camera took them, and how the scene stands in them.
        background: the scene, made of `frames`.
        frames: consecutive ones of the film.
    """
    drift = motion.drift[frames.start : frames.stop]
    if np.hypot(*np.ptp(drift, axis=0)) < LEAST_DRIFT_PX:
        return None
    chosen = motion.sampled(frames, SAMPLES)
    total, squares = np.zeros((2, film.height, film.width), np.float32)
    for i in chosen:
        rest = _without_scene(film, motion, background, i)
        cv2.accumulate(rest, total)
        cv2.accumulateSquare(rest, squares)
    n = len(chosen)
    mean = total / n
    error = np.sqrt(np.maximum(squares / n - mean * mean, (0.1 * background.noise) ** 2) / n)
    sure = np.abs(mean) > SIGNIFICANT * error
    if not (np.abs(mean[sure]) > STRONG * background.noise).any():
        return None
    around = cv2.dilate(sure.astype(np.uint8), np.ones((5, 5), np.uint8))
    return np.asarray(mean * around, np.float32)


def _without_scene(film: Film, motion: FilmMotion, background: Background, index: int) -> Image:
    whole, (dx, dy) = split_drift(motion.drift[index])
    scene = background.median[background.window(whole, film.height, film.width)]
    frame = motion.corrected(film.frame(index).astype(np.float32), index)
    return np.asarray(frame - read_shifted(scene, -dx, -dy), np.float32)
