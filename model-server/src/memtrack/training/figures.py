# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a training as SVG: its loss, and precision and recall of each level against the threshold."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from memtrack.evaluation.charts import Axis, Series, line_chart
from memtrack.training.thresholds import Curve

LOSSES = "loss.csv"
POINTS = 60


def write(folder: Path, curves: Mapping[str, Curve], chosen: Mapping[str, Sequence[float]]) -> None:
    """Writes `precision_recall_<level>.svg` for each curve, with the chosen thresholds in its axis, and `loss.svg`."""
    for number, (level, curve) in enumerate(curves.items()):
        if not len(curve.thresholds):
            continue
        some = np.unique(np.linspace(0, len(curve.thresholds) - 1, POINTS).astype(int))
        marks = [(0.0, "0"), (1.0, "1")]
        marks += [(values[number], f"{values[number]:.2f} {name.replace('_', ' ')}") for name, values in chosen.items()]
        lines = [
            Series(name, curve.thresholds[some].tolist(), values[some].tolist())
            for name, values in (("precision", curve.precision), ("recall", curve.recall))
        ]
        chart = line_chart(lines, Axis(f"threshold, level {level}", 0, 1, marks), Axis("share", 0, 1))
        (folder / f"precision_recall_{level}.svg").write_text(chart, encoding="utf-8")
    _write_losses(folder)


def _write_losses(folder: Path) -> None:
    path = folder / LOSSES
    if not path.is_file():
        return
    with path.open(encoding="utf-8", newline="") as file:
        rows = [(float(row["iteration"]), float(row["loss"])) for row in csv.DictReader(file)]
    iterations, losses = zip(*rows, strict=True)
    chart = line_chart(
        [Series("loss", iterations, losses)],
        Axis("iteration", 0, max(iterations)),
        Axis("loss", 0, max(losses)),
    )
    (folder / "loss.svg").write_text(chart, encoding="utf-8")
