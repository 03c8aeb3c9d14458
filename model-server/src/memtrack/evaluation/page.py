# SPDX-License-Identifier: GPL-3.0-or-later
"""The evaluation as one HTML page with its figures inside."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape

from memtrack import __version__
from memtrack.evaluation.charts import Axis, Series, histogram, line_chart
from memtrack.evaluation.curves import CurvePoint, best_f1
from memtrack.evaluation.evaluate import Evaluation
from memtrack.evaluation.matching import Counts, ratio
from memtrack.evaluation.report import Report, baseline_words, headline, similarity_words, speed_test
from memtrack.motility import SPEED_LAG_SECONDS
from memtrack.tracks import Motility

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #20242a; max-width: 1180px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.1em; margin: 2em 0 .4em; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; display: block; overflow-x: auto; }
th, td { padding: .25em .6em; text-align: right; border-bottom: 1px solid #e3e6ea; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } tr.total td { font-weight: 600; }
svg { width: 100%; height: auto; font: 12px system-ui, sans-serif; } svg text { fill: #4a515c; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(440px, 1fr)); gap: 1.5em; }
figure { margin: 0; } figcaption, p.note { color: #5a626e; font-size: .9em; }
"""

_HEADLINE = {
    "Detection and identity": ("precision", "recall", "F1", "HOTA", "DetA", "AssA", "LocA", "IDF1", "MOTA"),
    "Whole tracks": ("truth_tracks", "tracks", "false_tracks", "alpha", "beta", "JSC", "JSC_tracks", "RMSE_px"),
}


def as_page(report: Report) -> str:
    """The whole page."""
    total = report.total
    figures = [
        *_curves(report),
        *_steps(total),
        *_length_sweep(total, report.options.min_length),
        *_speeds(total),
    ]
    sections = [
        "<h1>Evaluation against the truth</h1><p class=note>A detection is right where "
        f"{escape(str(report.options.criterion))}, frame by frame, one to one.</p>",
        _headline(report),
        f'<div class="figures">{"".join(figures)}</div>',
        _classes(total),
        _step_table(report),
        _definitions(report),
    ]
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>MEMTrack evaluation</title>'
        f'<meta name="viewport" content="width=device-width"><style>{_STYLE}</style></head><body>'
        f"{''.join(sections)}</body></html>\n"
    )


def _table(head: Sequence[str], rows: Iterable[Sequence[str]], total: bool = False) -> str:
    body = [f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows]
    if total and len(body) > 1:
        body[-1] = body[-1].replace("<tr>", '<tr class="total">', 1)
    return f"<table><tr>{''.join(f'<th>{escape(word)}</th>' for word in head)}</tr>{''.join(body)}</table>"


def _figure(title: str, svg: str, caption: str) -> str:
    return f"<figure><h2>{escape(title)}</h2>{svg}<figcaption>{escape(caption)}</figcaption></figure>"


def _word(value: float) -> str:
    if math.isnan(value):
        return "–"
    return str(value) if isinstance(value, int) else f"{value:.3f}"


def _headline(report: Report) -> str:
    rows = {name: headline(evaluation) for name, evaluation in report.films.items()}
    if len(rows) > 1:
        rows["all films"] = headline(report.total)
    present = next(iter(rows.values()))
    tables = []
    for title, names in _HEADLINE.items():
        columns = [name for name in names if name in present]
        if columns:
            lines = [[film, *(_word(row[column]) for column in columns)] for film, row in rows.items()]
            head = ["film", *(column.replace("_", " ") for column in columns)]
            tables.append(f"<h2>{title}</h2>{_table(head, lines, total=len(rows) > 1)}")
    return "".join(tables)


def _curves(report: Report) -> list[str]:
    drawn = {name: curve for name, curve in report.curves.items() if curve}
    if not drawn:
        return []
    lines = [
        Series(
            name,
            [point.counts.recall for point in curve],
            [point.counts.precision for point in curve],
            [f"{name}, score ≥ {point.threshold:.3g}: F1 {point.counts.f1:.3f}" for point in curve],
        )
        for name, curve in drawn.items()
    ]
    bests = ", ".join(
        f"{name} {best_f1(curve).counts.f1:.3f} at {best_f1(curve).threshold:.3g}" for name, curve in drawn.items()
    )
    svg = line_chart(lines, Axis("recall", 0, 1), Axis("precision", 0, 1))
    caption = (
        "Candidates of each level, after the size filter and NMS, against the whole truth. "
        f"Greatest F1, with the threshold read off this truth: {bests}."
    )
    pooled = list(drawn.values())[-1]
    return [_figure("Precision and recall of the candidates", svg, caption), _against_threshold(pooled)]


def _against_threshold(curve: Sequence[CurvePoint]) -> str:
    x = [point.threshold for point in curve]
    svg = line_chart(
        _precision_recall_f1(x, [point.counts for point in curve], [f"score ≥ {value:.3g}" for value in x]),
        Axis("least score", min(0.0, x[0]), max(x[-1], 1e-9)),
        Axis("", 0, 1),
    )
    return _figure("Candidates of all levels by score", svg, "All levels pooled, after the size filter and NMS.")


def _precision_recall_f1(x: Sequence[float], counts: Sequence[Counts], where: Sequence[str]) -> list[Series]:
    lines = {
        "precision": [c.precision for c in counts],
        "recall": [c.recall for c in counts],
        "F1": [c.f1 for c in counts],
    }
    return [
        Series(name, x, y, [f"{place}: {name} {value:.3f}" for place, value in zip(where, y, strict=True)])
        for name, y in lines.items()
    ]


def _shown_steps(total: Evaluation) -> dict[str, Counts]:
    """The steps, without levels that have no candidate at all."""
    return {name: c for name, c in total.steps.items() if c.tp + c.fp or name not in ("low", "medium", "high")}


def _steps(total: Evaluation) -> list[str]:
    steps = _shown_steps(total)
    if len(steps) < 3:
        return []
    places = list(range(len(steps)))
    svg = line_chart(
        _precision_recall_f1(places, list(steps.values()), list(steps)),
        Axis("step", -0.3, len(steps) - 0.7, [(place, name) for place, name in zip(places, steps, strict=True)]),
        Axis("", 0, 1),
    )
    return [_figure("Step by step through the pipeline", svg, "Each step works on what the one before it left.")]


def _length_sweep(total: Evaluation, min_length: int) -> list[str]:
    shown = {least: counts for least, counts in total.lengths.items() if counts.tp + counts.fp}
    if len(shown) < 2:
        return []
    x = list(shown)
    svg = line_chart(
        _precision_recall_f1(x, list(shown.values()), [f"{least} frames or more" for least in x]),
        Axis("least length of a track, frames", 0, max(x)),
        Axis("", 0, 1),
    )
    return [_figure("Track Length Filter", svg, f"The results above keep tracks of {min_length} frames or more.")]


def _speeds(total: Evaluation) -> list[str]:
    truth, tracked = total.truth_speeds, total.tracked_speeds
    if not len(truth.frame_to_frame) or not len(tracked.frame_to_frame):
        return []
    test = speed_test(total)
    svg = histogram(
        [("truth", truth.frame_to_frame), ("tracked", tracked.frame_to_frame)],
        "mean speed of a track from frame to frame, µm/s",
    )
    caption = (
        f"Mean ± standard error: truth {truth.mean:.2f} ± {truth.standard_error:.2f}, tracked {tracked.mean:.2f} ± "
        f"{tracked.standard_error:.2f} µm/s, whether matched or not; "
        f"Welch's t-test: t = {test.t:.2f}, p = {test.p:.3g}. "
        f"Over a lag of {SPEED_LAG_SECONDS:g} s: {truth.mean_over_lag:.2f} and {tracked.mean_over_lag:.2f} µm/s."
    )
    return [_figure("Speed", svg, caption)]


def _classes(total: Evaluation) -> str:
    rows = [
        [
            "not measurable" if motility is Motility.UNKNOWN else motility.name.lower(),
            str(counts.tracks),
            str(counts.detected),
            f"{100 * ratio(counts.detected, counts.tracks):.0f} %",
            _word(ratio(counts.found, counts.points)),
        ]
        for motility, counts in total.classes.items()
        if counts.tracks
    ]
    if not rows:
        return ""
    return "<h2>Detected by motility</h2>" + _table(
        ["motility of the true track", "true tracks", "detected", "% detected", "recall of their points"], rows
    )


def _step_table(report: Report) -> str:
    steps = [*_shown_steps(report.total).items()]
    steps += [(baseline_words(baseline), baseline.counts) for baseline in report.baselines]
    rows = [
        [name, str(c.tp), str(c.fp), str(c.fn), _word(c.precision), _word(c.recall), _word(c.f1)] for name, c in steps
    ]
    return "<h2>Counts after each step</h2>" + _table(["step", "TP", "FP", "FN", "precision", "recall", "F1"], rows)


def _definitions(report: Report) -> str:
    return f"""<h2>What the numbers are</h2><ul>
<li>Precision, recall, F1: true positives, false positives and false negatives summed over frames and films, after the
last step. Truth rows marked as neither right nor wrong do not count, nor do detections that match only these.</li>
<li>HOTA, DetA, AssA, LocA (Luiten 2021): means over similarities of at least 0.05, 0.10 … 0.95; IDF1 (Ristani 2016),
MOTA (Bernardin 2008). Similarity: {escape(similarity_words(report.options))}.</li>
<li>alpha, beta, JSC, JSC tracks, RMSE: Particle Tracking Challenge (Chenouard 2014), gate
{report.options.challenge_gate_px:g} px.</li>
<li>A true track is detected when at least half of its points are matched; a false track is one of whose points less
than half match the truth. Motility: the class the truth file gives, else from the greatest diffusivity of the true
track (none up to 0.075, low to 0.25, medium to 1, high above 1 µm²/s).</li>
</ul><p class="note">MEMTrack {escape(__version__)}</p>"""
