# SPDX-License-Identifier: GPL-3.0-or-later
"""How a track moves: mean squared displacement, diffusivity and class, and its mean speed.

Paper section "Determining Track Length and Motion Characteristics"; the same definitions as the plug-in's motility
analysis. Only observed points count, unless a track has no other: steps between interpolated ones are not measured.
"""

from __future__ import annotations

import math

import numpy as np
from jaxtyping import Float, Int

from memtrack.film import Calibration
from memtrack.tracks import Motility, TrackTable

SPEED_LAG_SECONDS = 0.1
"""Lag of the second speed, and least lag of the diffusivity: below it the error of the positions hides the motion."""

GREATEST_LAG_SECONDS = 2.5
"""Greatest lag of the diffusivity (the paper's equation for D(tau))."""

_GREATEST_DIFFUSIVITY = {Motility.NONE: 0.075, Motility.LOW: 0.25, Motility.MEDIUM: 1.0}


def motility_of(peak_diffusivity: float) -> Motility:
    """The class of a peak diffusivity in um^2/s; UNKNOWN for NaN."""
    if math.isnan(peak_diffusivity):
        return Motility.UNKNOWN
    return next((c for c, most in _GREATEST_DIFFUSIVITY.items() if peak_diffusivity <= most), Motility.HIGH)


def frames_in(seconds: float, interval_seconds: float) -> int:
    """The nearest number of frames, at least one."""
    return max(1, math.floor(seconds / interval_seconds + 0.5))


def displacements(track: TrackTable, lag: int) -> Float[np.ndarray, " pairs"]:
    """Distance in pixels between all points of one track that are `lag` frames apart."""
    later = np.searchsorted(track.frames, track.frames + lag)
    earlier = np.flatnonzero(later < len(track))
    earlier = earlier[track.frames[later[earlier]] == track.frames[earlier] + lag]
    later = later[earlier]
    steps: np.ndarray = np.hypot(track.x[later] - track.x[earlier], track.y[later] - track.y[earlier])
    return steps


def mean_squared_displacement(track: TrackTable, lags: Int[np.ndarray, " lags"]) -> Float[np.ndarray, " lags"]:
    """MSD in square pixels of one track at lags in frames; NaN where no two points are that far apart."""
    squares = (displacements(track, int(lag)) ** 2 for lag in lags)
    return np.array([square.mean() if len(square) else np.nan for square in squares])


def peak_diffusivity(track: TrackTable, calibration: Calibration) -> float:
    """Greatest (MSD(lag) - floor) / (4 lag) in um^2/s, over lags from 0.1 s to the least of 2.5 s and half the track.

    The floor is what errors of position add to every lag: the straight line through the first two lags, carried on to
    lag 0. The paper starts at one frame and takes nothing away; there 0.3 px of error make a cell at rest "medium".
    NaN for a track of fewer than three frames, and where the film has no pixel size or frame interval.
    """
    pixel, interval = calibration.pixel_size_um, calibration.frame_interval_seconds
    track = _observed(track)
    if pixel is None or interval is None or not len(track):
        return math.nan
    greatest = min(frames_in(GREATEST_LAG_SECONDS, interval), int(track.frames[-1] - track.frames[0]) // 2)
    if greatest < 1:
        return math.nan
    first, second = mean_squared_displacement(track, np.array([1, 2]))
    floor = max(0.0, float(np.nan_to_num(2 * first - second)))
    lags = np.arange(min(frames_in(SPEED_LAG_SECONDS, interval), greatest), greatest + 1)
    above = np.maximum(mean_squared_displacement(track, lags) - floor, 0.0)
    diffusivity = above * pixel**2 / (4 * lags * interval)
    return float(np.nanmax(diffusivity)) if np.isfinite(diffusivity).any() else math.nan


def track_motility(track: TrackTable, calibration: Calibration) -> Motility:
    """What the file says of the track (its most frequent class), else the class of its peak diffusivity."""
    known = track.motility[track.motility != Motility.UNKNOWN]
    if len(known):
        return Motility(int(np.bincount(known).argmax()))
    return motility_of(peak_diffusivity(track, calibration))


def mean_speed(track: TrackTable) -> float:
    """Length of the way along the points of one track over its time, in pixels a frame; NaN for a single point."""
    track = _observed(track)
    span = int(track.frames[-1] - track.frames[0]) if len(track) else 0
    return float(np.hypot(np.diff(track.x), np.diff(track.y)).sum()) / span if span else math.nan


def lag_speed(track: TrackTable, lag: int) -> float:
    """Mean distance of the points of one track that are `lag` frames apart, a frame; NaN if there are none."""
    steps = displacements(_observed(track), lag)
    return float(steps.mean()) / lag if len(steps) else math.nan


def _observed(track: TrackTable) -> TrackTable:
    return track if track.interpolated.all() else track.select(~track.interpolated)
