# SPDX-License-Identifier: GPL-3.0-or-later
"""Line charts and histograms as inline SVG, so that the report is one file and needs no plotting library."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from jaxtyping import Float

WIDTH, HEIGHT = 560, 340
_LEFT, _RIGHT, _TOP, _BOTTOM = 56, 16, 34, 52
COLOURS = ("#1f6fb4", "#d9642a", "#2d8f5a", "#8a5bb5", "#6b7280")


@dataclass(frozen=True, slots=True)
class Series:
    """One line: its name and points; a point with NaN is left out. `note` is the tip shown at each point."""

    name: str
    x: Sequence[float]
    y: Sequence[float]
    notes: Sequence[str] = ()


@dataclass(frozen=True, slots=True)
class Axis:
    """Range, name and marks of an axis; without `marks` round numbers are taken."""

    name: str
    low: float
    high: float
    marks: Sequence[tuple[float, str]] = ()

    def ticks(self) -> Sequence[tuple[float, str]]:
        """Places and words of the marks."""
        if self.marks:
            return self.marks
        rough = (self.high - self.low) / 5
        power = 10 ** math.floor(math.log10(rough))
        step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough * 0.999)
        first = math.ceil(self.low / step - 1e-9)
        return [(i * step, f"{i * step:g}") for i in range(first, math.floor(self.high / step + 1e-9) + 1)]


def line_chart(series: Sequence[Series], x: Axis, y: Axis) -> str:
    """Lines with a dot at each point and a legend above."""
    parts = _frame(x, y, [line.name for line in series])
    for line, colour in zip(series, COLOURS, strict=False):
        points = [
            (_across(x, px), _up(y, py), note)
            for px, py, note in zip(line.x, line.y, line.notes or [""] * len(line.x), strict=True)
            if math.isfinite(px) and math.isfinite(py)
        ]
        path = " ".join(f"{px:.1f},{py:.1f}" for px, py, _ in points)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        for px, py, note in points:
            tip = f"<title>{escape(note)}</title>" if note else ""
            parts.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3.2" fill="{colour}">{tip}</circle>')
    return _svg(parts)


def histogram(samples: Sequence[tuple[str, Float[np.ndarray, " _"]]], name: str, bins: int = 16) -> str:
    """Share of each sample in bins common to all, side by side, with each sample's mean as a dashed line."""
    values = np.concatenate([sample for _, sample in samples])
    edges = np.linspace(0, max(float(values.max(initial=0)) * 1.001, 1e-9), bins + 1)
    shares = [np.histogram(sample, edges)[0] / max(1, len(sample)) for _, sample in samples]
    x = Axis(name, 0, float(edges[-1]))
    y = Axis("share of tracks", 0, max(0.05, max(float(share.max(initial=0)) for share in shares) * 1.1))
    parts = _frame(x, y, [f"{label} (n = {len(sample)})" for label, sample in samples])
    bar = (_across(x, edges[1]) - _across(x, edges[0])) / (len(samples) + 0.4)
    for k, ((_, sample), share) in enumerate(zip(samples, shares, strict=True)):
        for i in np.flatnonzero(share):
            left, top = _across(x, edges[i]) + (k + 0.2) * bar, _up(y, share[i])
            parts.append(
                f'<rect x="{left:.1f}" y="{top:.1f}" width="{bar:.1f}" height="{_up(y, 0) - top:.1f}" '
                f'fill="{COLOURS[k]}" fill-opacity="0.8"><title>{share[i]:.3f}</title></rect>'
            )
        if len(sample):
            mean = _across(x, float(sample.mean()))
            parts.append(
                f'<line x1="{mean:.1f}" x2="{mean:.1f}" y1="{_TOP}" y2="{_up(y, 0):.1f}" '
                f'stroke="{COLOURS[k]}" stroke-width="2" stroke-dasharray="5 3"/>'
            )
    return _svg(parts)


def _across(axis: Axis, value: float) -> float:
    return _LEFT + (value - axis.low) / (axis.high - axis.low) * (WIDTH - _LEFT - _RIGHT)


def _up(axis: Axis, value: float) -> float:
    return HEIGHT - _BOTTOM - (value - axis.low) / (axis.high - axis.low) * (HEIGHT - _TOP - _BOTTOM)


def _frame(x: Axis, y: Axis, names: Sequence[str]) -> list[str]:
    """Axes, grid and legend."""
    parts = []
    for value, word in y.ticks():
        at = _up(y, value)
        parts.append(f'<line x1="{_LEFT}" x2="{WIDTH - _RIGHT}" y1="{at:.1f}" y2="{at:.1f}" stroke="#e3e6ea"/>')
        parts.append(f'<text x="{_LEFT - 8}" y="{at + 4:.1f}" text-anchor="end">{escape(word)}</text>')
    for value, word in x.ticks():
        at = _across(x, value)
        parts.append(
            f'<line x1="{at:.1f}" x2="{at:.1f}" y1="{HEIGHT - _BOTTOM}" y2="{HEIGHT - _BOTTOM + 5}" stroke="#9aa1ab"/>'
        )
        parts.append(f'<text x="{at:.1f}" y="{HEIGHT - _BOTTOM + 19}" text-anchor="middle">{escape(word)}</text>')
    parts.append(
        f'<line x1="{_LEFT}" x2="{WIDTH - _RIGHT}" y1="{HEIGHT - _BOTTOM}" y2="{HEIGHT - _BOTTOM}" stroke="#9aa1ab"/>'
    )
    middle_x, middle_y = (_LEFT + WIDTH - _RIGHT) / 2, (_TOP + HEIGHT - _BOTTOM) / 2
    parts.append(f'<text x="{middle_x}" y="{HEIGHT - 12}" text-anchor="middle">{escape(x.name)}</text>')
    parts.append(f'<text transform="translate(14 {middle_y}) rotate(-90)" text-anchor="middle">{escape(y.name)}</text>')
    left = _LEFT
    for name, colour in zip(names, COLOURS, strict=False):
        parts.append(f'<rect x="{left}" y="8" width="14" height="10" rx="2" fill="{colour}"/>')
        parts.append(f'<text x="{left + 20}" y="17">{escape(name)}</text>')
        left += 40 + 7 * len(name)
    return parts


def _svg(parts: Sequence[str]) -> str:
    inside = "\n".join(parts)
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">\n{inside}\n</svg>'
