# SPDX-License-Identifier: GPL-3.0-or-later
"""What anyone can run instead, at its best: spots linked into tracks, every setting chosen by the truth of that film.

LoG and trackpy's locate (`memtrack.evaluation.baselines`) are linked by trackpy, TrackMate's LoG detector by its
simple LAP tracker; both with 15 px and gaps of 2 frames, TrackMate's own defaults. Tracks must be as long as ours
that are not sure to be real, or half as long, whichever serves the truth better.
"""

from __future__ import annotations

import csv
import itertools
import subprocess
import warnings
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np
import tifffile

from accuracy.films import Made
from accuracy.scores import Scores, score
from memtrack.evaluation import baselines
from memtrack.evaluation.matching import Criterion, compare
from memtrack.evaluation.stages import as_table
from memtrack.film import ArrayFilm
from memtrack.tracks import TrackTable

RADII_PX = (2.5, 4.0, 6.0)
SPOTS_A_FRAME = (4, 6, 8, 10, 13, 16, 20, 25, 32, 40, 50, 64, 80, 100)
"""Thresholds: each lets this number of spots a frame through, on average."""
LINK_PX, GAP_FRAMES = 15, 2
TRACKMATE_SECONDS = 3600
LOOKED_AT = 5
"""Frames, spread over the film, that radius and sign of detections are chosen by."""
NAMES = {
    "log": "LoG, linked",
    "log-deviation": "LoG on frame - median, linked",
    "trackpy": "trackpy on frame - median",
}
INPUTS = {"log": "TrackMate", "log-deviation": "TrackMate on frame - median"}


def spot_detectors(film: Made) -> dict[str, Scores]:
    """LoG on the frame, LoG and trackpy on the frame minus the median, linked by trackpy, with their best settings."""
    results = {}
    for name, title in NAMES.items():
        radius, sign = _choose(name, film, tuple(baselines.SIGNS))
        spots = as_table(baselines.detect(name, film.film, radius, sign))
        tracks = ((f"{t:.3g}", _link(kept)) for t, kept in _thresholds(spots))
        results[title] = _best(film, tracks, f"radius {radius:g} px, {sign}, strength >= ")
    return results


def trackmate(film: Made, class_path: str, folder: Path) -> dict[str, Scores]:
    """TrackMate on the film and on the film minus its median, of the sign that suits the LoG detector, at its best."""
    folder.mkdir(parents=True, exist_ok=True)
    results = {}
    for name, title in INPUTS.items():
        _, sign = _choose(name, film, ("bright", "dark"))
        frames = np.stack([film.film.frame(i) for i in range(film.film.frame_count)]).astype(np.float32)
        images = frames if name == "log" else frames - np.median(frames, axis=0).astype(np.float32)
        given, table = folder / "for-trackmate.tif", folder / f"trackmate-{name}.csv"
        tifffile.imwrite(given, images if sign == "bright" else -images, imagej=True, metadata={"axes": "TYX"})
        source = Path(__file__).with_name("TrackMatePeer.java")
        counts, radii = (",".join(map(str, values)) for values in (SPOTS_A_FRAME, RADII_PX))
        words = ["java", "-Xmx4g", "-Djava.awt.headless=true", "-cp", class_path, str(source)]
        subprocess.run(
            [*words, str(given), str(table), radii, counts, str(min(film.least_lengths))],
            check=True,
            timeout=TRACKMATE_SECONDS,
        )
        given.unlink()
        results[title] = _best(film, _read(table), f"{sign}, ")
    return results


def _choose(name: str, film: Made, signs: tuple[str, ...]) -> tuple[float, str]:
    """The radius and sign whose detections, at their best threshold, have the greatest F1 in a few frames."""
    step = max(1, film.film.frame_count // LOOKED_AT)
    some = ArrayFilm(np.stack([film.film.frame(i) for i in range(0, film.film.frame_count, step)]))
    truth = film.truth.select(film.truth.frames % step == 0)
    truth = replace(truth, frames=truth.frames // step)

    def quality(settings: tuple[float, str]) -> float:
        spots = as_table(baselines.detect(name, some, *settings))
        return max((compare(truth, kept, Criterion()).counts.f1 for _, kept in _thresholds(spots)), default=0.0)

    return max(itertools.product(RADII_PX, signs), key=quality)


def _thresholds(spots: TrackTable) -> Iterable[tuple[float, TrackTable]]:
    frames = len(np.unique(spots.frames))
    order = np.sort(spots.scores)[::-1]
    for count in SPOTS_A_FRAME:
        if 0 < count * frames <= len(order):
            threshold = float(order[count * frames - 1])
            yield threshold, spots.select(spots.scores >= threshold)


def _link(spots: TrackTable) -> TrackTable:
    import pandas  # comes with trackpy
    import trackpy

    trackpy.quiet()
    table = pandas.DataFrame({"frame": spots.frames, "x": spots.x, "y": spots.y})
    with warnings.catch_warnings():  # trackpy 0.7 calls what pandas 3 deprecates
        warnings.simplefilter("ignore")
        # In crowds of spots too large to be solved exactly, the range shrinks as far as it must.
        linked = trackpy.link(table, LINK_PX, memory=GAP_FRAMES, adaptive_stop=1, adaptive_step=0.8)
    return TrackTable.of(linked["frame"], linked["particle"], linked["x"], linked["y"])


def _read(table: Path) -> Iterable[tuple[str, TrackTable]]:
    """What TrackMatePeer wrote: tracks by radius and threshold."""
    runs: dict[str, list[tuple[float, ...]]] = defaultdict(list)
    with table.open(encoding="utf-8", newline="") as lines:
        for row in csv.DictReader(lines):
            values = tuple(float(row[key]) for key in ("frame", "track", "x", "y"))
            runs[f"radius {float(row['radius']):g} px, quality >= {float(row['threshold']):.3g}"].append(values)
    for settings, rows in runs.items():
        yield settings, TrackTable.of(*zip(*rows, strict=True))


def _best(film: Made, runs: Iterable[tuple[str, TrackTable]], words: str) -> Scores:
    """The scores of the run and least length of tracks with the greatest F1; those of no track if there is none."""
    found = [(0.0, "no track", TrackTable.of([], [], [], []))]
    for how, tracks in runs:
        for least in film.least_lengths:
            kept = tracks.select(tracks.lengths >= least)
            found.append((compare(film.truth, kept, Criterion()).counts.f1, f"{how}, {least} frames", kept))
    _, how, tracks = max(found, key=lambda run: run[0])
    return score(film.truth, tracks, words + how)
