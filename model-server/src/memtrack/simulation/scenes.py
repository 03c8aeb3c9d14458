# SPDX-License-Identifier: GPL-3.0-or-later
"""What bacteria swim in front of: textures of zero mean and unit standard deviation, grains as large as they are."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
from jaxtyping import Float32

Texture = Float32[np.ndarray, "h w"]


def mottled(h: int, w: int, scale: float, rng: np.random.Generator) -> Texture:
    """Isotropic grain like collagen out of focus: autocorrelation 0.5 at about 7 px at `scale` 1."""
    fine = 4.2 * scale * rng.uniform(0.6, 1.5)
    noise = rng.standard_normal((h, w), np.float32)
    out = cv2.GaussianBlur(noise, (0, 0), fine)
    broad = cv2.GaussianBlur(out, (0, 0), 2.5 * fine)
    return _standard(out - broad * np.float32(rng.uniform(0, 1)))


def cloudy(h: int, w: int, scale: float, rng: np.random.Generator) -> Texture:
    """Grain of all sizes: amplitude falls with spatial frequency as a power."""
    fy, fx = np.fft.fftfreq(h)[:, None], np.fft.rfftfreq(w)[None, :]
    frequency = np.hypot(fx, fy) + 0.004
    cut = np.exp(-np.square(frequency * 6 * scale))
    spectrum = np.fft.rfft2(rng.standard_normal((h, w))) * frequency ** -rng.uniform(0.8, 1.8) * cut
    return _standard(np.fft.irfft2(spectrum, (h, w)).astype(np.float32))


def fibrous(h: int, w: int, scale: float, rng: np.random.Generator) -> Texture:
    """Curved fibres, sharp and blurred, bright and dark, often with one preferred direction."""
    out = np.zeros((h, w), np.float32)
    direction, order = rng.uniform(0, np.pi), rng.choice([0.2, 0.6, 3.0])
    for blur in (0.8, 2.0, 4.5):
        layer = np.zeros((h, w), np.float32)
        for _ in range(max(1, int(h * w / 2500 * rng.uniform(0.3, 1.3)))):
            n = int(rng.integers(6, 20))
            angles = direction + rng.normal(0, order) + np.cumsum(rng.normal(0, 0.18, n))
            steps = 12 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
            points = rng.uniform([-60, -60], [w + 60, h + 60]) + np.cumsum(steps, axis=0)
            level = float(rng.choice([1.0, 1.0, -0.7]) * rng.uniform(0.3, 1.0))
            thick = int(rng.integers(1, max(2, round(3 * scale)) + 1))
            line = np.rint(points * 8).astype(np.int32)[:, None]
            cv2.polylines(layer, [line], False, level, thick, cv2.LINE_AA if blur < 1 else cv2.LINE_8, 3)
        out += _standard(cv2.GaussianBlur(layer, (0, 0), blur * scale)) * np.float32(rng.uniform(0.3, 1.0))
    return _standard(out)


def clear(h: int, w: int, scale: float, rng: np.random.Generator) -> Texture:
    """Nearly nothing: broad unevenness and dust out of focus, as in water on glass."""
    out = 0.5 * _standard(cv2.GaussianBlur(rng.standard_normal((h, w), np.float32), (0, 0), 20 * scale))
    return _standard(out + 0.7 * dust(h, w, scale, int(h * w / 20000) + 2, rng))


def rings(h: int, w: int, scale: float, rng: np.random.Generator) -> Texture:
    """Objects far out of focus, each a set of rings."""
    out = 0.4 * mottled(h, w, scale, rng)
    y, x = np.mgrid[:h, :w].astype(np.float32)
    for _ in range(int(h * w / 9000 * rng.uniform(0.5, 1.5)) + 1):
        distance = np.hypot(x - rng.uniform(0, w), y - rng.uniform(0, h))
        size = np.float32(scale * rng.uniform(8, 30))
        wave = np.cos(distance / np.float32(scale * rng.uniform(1.5, 4))) * np.exp(-0.5 * np.square(distance / size))
        out += np.float32(rng.normal(0, 1)) * wave
    return _standard(out)


def cells_of_foam(h: int, w: int, scale: float, rng: np.random.Generator) -> Texture:
    """Thin bright walls between pores (a family kept for validation)."""
    seeds = np.full((h, w), 255, np.uint8)
    count = max(3, int(h * w / np.square(scale * rng.uniform(18, 40))))
    seeds[rng.integers(0, h, count), rng.integers(0, w, count)] = 0
    distance = cv2.distanceTransform(seeds, cv2.DIST_L2, 5)
    walls = distance - cv2.GaussianBlur(distance, (0, 0), 3 * scale)
    return _standard(
        cv2.GaussianBlur(walls, (0, 0), 1.2 * scale) + 0.5 * distance.std() * mottled(h, w, scale, rng) / 3
    )


def granular(h: int, w: int, scale: float, rng: np.random.Generator) -> Texture:
    """Packed round grains of either sign (a family kept for validation)."""
    out = np.zeros((h, w), np.float32)
    for _ in range(int(h * w / np.square(11 * scale))):
        centre = (int(rng.integers(w)), int(rng.integers(h)))
        cv2.circle(out, centre, max(1, int(scale * rng.uniform(2, 6))), float(rng.normal()), -1, cv2.LINE_AA)
    return _standard(cv2.GaussianBlur(out, (0, 0), 1.6 * scale))


def dust(h: int, w: int, scale: float, count: int, rng: np.random.Generator) -> Texture:
    """Single specks of a few pixels, sharp and blurred; not standardised (heights of about 1 to 4)."""
    out = np.zeros((h, w), np.float32)
    for blur in (1.2, 2.5, 5.0):
        layer = np.zeros((h, w), np.float32)
        for _ in range(count // 3 + 1):
            centre = (int(rng.integers(w)), int(rng.integers(h)))
            axes = (max(1, int(scale * rng.uniform(1, 6))), max(1, int(scale * rng.uniform(1, 4))))
            level = float(rng.choice([-1, 1]) * rng.uniform(1, 4))
            cv2.ellipse(layer, centre, axes, float(rng.uniform(0, 180)), 0, 360, level, -1, cv2.LINE_AA)
        out += cv2.GaussianBlur(layer, (0, 0), blur * scale)
    return out


def _standard(image: Texture) -> Texture:
    image = image - image.mean()
    return (image / max(float(image.std()), 1e-6)).astype(np.float32)


SCENES: dict[str, Callable[[int, int, float, np.random.Generator], Texture]] = {
    "mottled": mottled,
    "cloudy": cloudy,
    "fibrous": fibrous,
    "clear": clear,
    "rings": rings,
    "foam": cells_of_foam,
    "granular": granular,
}
