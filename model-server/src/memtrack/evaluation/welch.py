# SPDX-License-Identifier: GPL-3.0-or-later
"""Welch's t-test for two samples of unequal variance, as the paper compares populations of speeds."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True, slots=True)
class TTest:
    """Student's t, degrees of freedom (Welch and Satterthwaite) and the two-sided p; NaN when undefined."""

    t: float
    degrees: float
    p: float


def welch_t_test(first: Float[np.ndarray, " n"], second: Float[np.ndarray, " m"]) -> TTest:
    """Test whether two samples have the same mean; undefined for fewer than two values or no spread at all."""
    if len(first) < 2 or len(second) < 2:
        return TTest(math.nan, math.nan, math.nan)
    a, b = float(first.var(ddof=1)) / len(first), float(second.var(ddof=1)) / len(second)
    if a + b == 0:
        return TTest(math.nan, math.nan, math.nan)
    t = float(first.mean() - second.mean()) / math.sqrt(a + b)
    degrees = (a + b) ** 2 / (a**2 / (len(first) - 1) + b**2 / (len(second) - 1))
    return TTest(t, degrees, _incomplete_beta(degrees / 2, 0.5, degrees / (degrees + t * t)))


def _incomplete_beta(a: float, b: float, x: float) -> float:
    """Regularised incomplete beta function I_x(a, b) by its continued fraction (Abramowitz and Stegun 26.5.8)."""
    if x <= 0 or x >= 1:
        return min(max(x, 0.0), 1.0)
    if x > (a + 1) / (a + b + 2):
        return 1 - _incomplete_beta(b, a, 1 - x)
    log_front = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)
    # Lentz's method; the terms come in pairs, even then odd.
    fraction, c, d = 1.0, 1.0, 0.0
    for i in range(400):
        m = i // 2
        if i == 0:
            term = 1.0
        elif i % 2 == 0:
            term = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        else:
            term = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        d = 1 / _away_from_zero(1 + term * d)
        c = _away_from_zero(1 + term / c)
        fraction *= c * d
        if i and abs(c * d - 1) < 1e-14:
            break
    return math.exp(log_front) * (fraction - 1) / a


def _away_from_zero(value: float) -> float:
    return value if abs(value) > 1e-300 else 1e-300
