# SPDX-License-Identifier: GPL-3.0-or-later
"""What an evaluation says in numbers: a table for the terminal and one JSON; `memtrack.evaluation.page` draws it."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import Any

from memtrack import __version__
from memtrack.evaluation.baselines import TunedBaseline
from memtrack.evaluation.curves import CurvePoint
from memtrack.evaluation.evaluate import Evaluation, Options, Speeds
from memtrack.evaluation.matching import Counts
from memtrack.evaluation.welch import TTest, welch_t_test
from memtrack.tracks import Motility


@dataclass(frozen=True, slots=True)
class Report:
    """Evaluations of films by name, and over all of them the curves by the name of the level and the baselines."""

    films: Mapping[str, Evaluation]
    curves: Mapping[str, Sequence[CurvePoint]]
    options: Options
    baselines: Sequence[TunedBaseline] = ()

    @property
    def total(self) -> Evaluation:
        """All films added up."""
        return reduce(add, self.films.values())


def headline(evaluation: Evaluation) -> dict[str, float]:
    """The measures of the result by name, in the order of the table."""
    counts = evaluation.result
    row = {"precision": counts.precision, "recall": counts.recall, "F1": counts.f1}
    if evaluation.tracking is not None and evaluation.challenge is not None:
        row |= evaluation.tracking.measures | evaluation.challenge.measures
        row |= {
            "truth_tracks": evaluation.truth_tracks,
            "tracks": evaluation.predicted_tracks,
            "false_tracks": evaluation.false_tracks,
        }
    return row


def as_text(report: Report) -> str:
    """A table for the terminal: a line a film, and one for all when there are several."""
    rows = {name: headline(evaluation) for name, evaluation in report.films.items()}
    if len(rows) > 1:
        rows["all films"] = headline(report.total)
    columns = list(next(iter(rows.values())))
    first = max(len(name) for name in ("film", *rows))
    widths = [max(6, len(column)) for column in columns]
    lines = ["  ".join([f"{'film':<{first}}", *(f"{c:>{w}}" for c, w in zip(columns, widths, strict=True))])]
    for name, row in rows.items():
        cells = (f"{_number(row[column]):>{width}}" for column, width in zip(columns, widths, strict=True))
        lines.append("  ".join([f"{name:<{first}}", *cells]))
    for baseline in report.baselines:
        c = baseline.counts
        lines.append(f"{baseline_words(baseline)}: precision {c.precision:.3f}, recall {c.recall:.3f}, F1 {c.f1:.3f}")
    return "\n".join(lines)


def baseline_words(baseline: TunedBaseline) -> str:
    """What a baseline is, and the settings it was given."""
    return (
        f"detections of {baseline.name} with settings tuned on this truth "
        f"(radius {baseline.radius_px:g} px, {baseline.sign}, strength >= {baseline.threshold:.3g})"
    )


def _number(value: float) -> str:
    if math.isnan(value):
        return "-"
    return str(value) if isinstance(value, int) else f"{value:.3f}"


def as_json(report: Report) -> str:
    """Everything that was measured, all films together and each; null where there is nothing to measure."""
    options = report.options
    content = {
        "memtrack": __version__,
        "criterion": str(options.criterion),
        "similarity_of_hota": similarity_words(options),
        "challenge_gate_px": options.challenge_gate_px,
        "min_length": options.min_length,
        "all_films": _evaluation(report.total),
        "films": {name: _evaluation(evaluation) for name, evaluation in report.films.items()},
        "curves": {
            name: [{"threshold": point.threshold, **_counts(point.counts)} for point in curve]
            for name, curve in report.curves.items()
        },
        "baselines_tuned_on_this_truth": {
            baseline.name: {
                "radius_px": baseline.radius_px,
                "sign": baseline.sign,
                "threshold": baseline.threshold,
                **_counts(baseline.counts),
            }
            for baseline in report.baselines
        },
    }
    return json.dumps(_plain(content), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def similarity_words(options: Options) -> str:
    """Which similarity HOTA, IDF1 and MOTA use."""
    if options.criterion.distance_px is None:
        return "IoU of the boxes"
    return f"1 - distance of the centres / {options.criterion.distance_px:g} px"


def _evaluation(evaluation: Evaluation) -> dict[str, Any]:
    return {
        **headline(evaluation),
        "steps": {name: _counts(counts) for name, counts in evaluation.steps.items()},
        "min_length_sweep": {str(least): _counts(counts) for least, counts in evaluation.lengths.items()},
        "by_motility": {
            motility.name.lower(): {
                "tracks": counts.tracks,
                "detected": counts.detected,
                "points": counts.points,
                "found": counts.found,
            }
            for motility, counts in evaluation.classes.items()
            if counts.tracks
        },
        "speed_um_per_s": {
            "truth": _speeds(evaluation.truth_speeds),
            "tracked": _speeds(evaluation.tracked_speeds),
            "t_test": _test(speed_test(evaluation)),
            "by_motility": {
                motility.name.lower(): {
                    "truth": _speeds(evaluation.truth_speeds.of(motility)),
                    "tracked": _speeds(evaluation.tracked_speeds.of(motility)),
                }
                for motility in Motility
            },
        },
    }


def speed_test(evaluation: Evaluation) -> TTest:
    """Welch's t-test of the mean speeds from frame to frame, truth against tracked."""
    return welch_t_test(evaluation.truth_speeds.frame_to_frame, evaluation.tracked_speeds.frame_to_frame)


def _test(test: TTest) -> dict[str, float]:
    return {"t": test.t, "degrees_of_freedom": test.degrees, "p": test.p}


def _speeds(speeds: Speeds) -> dict[str, float]:
    return {
        "tracks": len(speeds.frame_to_frame),
        "mean": speeds.mean,
        "standard_error": speeds.standard_error,
        "mean_over_lag": speeds.mean_over_lag,
    }


def _counts(counts: Counts) -> dict[str, float]:
    return {
        "tp": counts.tp,
        "fp": counts.fp,
        "fn": counts.fn,
        "precision": counts.precision,
        "recall": counts.recall,
        "f1": counts.f1,
    }


def _plain(value: Any) -> Any:
    """The same with null for NaN, which JSON does not have."""
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
