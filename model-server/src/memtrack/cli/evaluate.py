# SPDX-License-Identifier: GPL-3.0-or-later
"""`memtrack evaluate`: truth against tracks and detections, of one film or of many."""

from __future__ import annotations

import argparse
import csv
import io
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from memtrack.detections_io import read_detections
from memtrack.errors import InvalidInputError, SettingsError
from memtrack.evaluation.curves import CurvePoint, precision_recall_curve
from memtrack.evaluation.evaluate import FilmData, Options, evaluate
from memtrack.evaluation.matching import Criterion
from memtrack.evaluation.page import as_page
from memtrack.evaluation.report import Report, as_json, as_text
from memtrack.evaluation.stages import PrunerSettings, candidate_steps
from memtrack.files import read_text, write_text
from memtrack.film import Calibration
from memtrack.tracks_io import read_tracks

_LIST_COLUMNS = ("film", "truth", "tracks", "detections", "pixel_size_um", "frame_interval_s")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Describe the options of `memtrack evaluate`."""
    parser.add_argument("--truth", type=Path, help="the truth: CSV, .mdf of MTrackJ, .xml of TrackMate, or MOT .txt")
    parser.add_argument("--tracks", type=Path, help="the tracks to judge, in any of these formats")
    parser.add_argument("--detections", type=Path, help="the detector's candidates, as `memtrack detect` writes them")
    parser.add_argument(
        "--films",
        type=Path,
        help=f"instead of the three above: a CSV with the columns {', '.join(_LIST_COLUMNS)}, a row a film; "
        "paths start at its folder, and the last four may be missing or empty",
    )
    parser.add_argument("--out", type=Path, required=True, help="folder for evaluation.html and evaluation.json")
    parser.add_argument("--iou", type=_share, default=0.1, help="boxes match above this overlap (default 0.1)")
    parser.add_argument("--distance", type=_positive, metavar="PX", help="match centres nearer than this instead")
    parser.add_argument(
        "--box-size", type=_positive, default=30.0, metavar="PX", help="box of a row that has none (default 30)"
    )
    parser.add_argument(
        "--min-length", type=int, default=1, metavar="FRAMES", help="drop shorter tracks (default 1: keep all)"
    )
    parser.add_argument(
        "--challenge-gate",
        type=_positive,
        metavar="PX",
        help="gate of alpha, beta, JSC and RMSE (default: --distance, or 5)",
    )
    parser.add_argument("--pixel-size-um", type=_positive, help="edge of a pixel, where the files do not say")
    parser.add_argument("--frame-interval-s", type=_positive, help="time between frames, where the files do not say")
    parser.add_argument(
        "--thresholds",
        type=float,
        nargs="+",
        metavar="SCORE",
        help="score thresholds of the low, medium and high level: follows the candidates through the pruner",
    )
    parser.add_argument("--max-size", type=_positive, default=35.0, metavar="PX", help="pruner: greatest edge of a box")
    parser.add_argument("--nms-iou", type=_share, default=0.7, help="pruner: greatest overlap of two boxes")


def run(args: argparse.Namespace) -> int:
    """Evaluate, write the page and the JSON, print the table.

    Raises:
        InvalidInputError: a file or an option cannot be used.
    """
    films = _films(args)
    options = Options(
        criterion=Criterion(args.iou, args.distance, args.box_size),
        min_length=_min_length(args.min_length),
        challenge_gate_px=args.challenge_gate or args.distance or 5.0,
        pruner=None if args.thresholds is None else PrunerSettings(tuple(args.thresholds), args.max_size, args.nms_iou),
    )
    report = Report({film.name: evaluate(film, options) for film in films}, _curves(films, options), options)
    try:
        args.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInputError(f"cannot make the folder {args.out}: {error.strerror}; choose another --out") from error
    write_text(args.out / "evaluation.json", as_json(report))
    write_text(args.out / "evaluation.html", as_page(report))
    print(as_text(report))
    return 0


@dataclass(frozen=True, slots=True)
class _Row:
    """Where one film's files are."""

    name: str
    truth: Path
    tracks: Path | None
    detections: Path | None
    calibration: Calibration


def _films(args: argparse.Namespace) -> list[FilmData]:
    """Read every film; all of them have tracks, or none, and the same for candidates."""
    general = Calibration(args.pixel_size_um, args.frame_interval_s)
    if args.films is not None:
        if args.truth or args.tracks or args.detections:
            raise SettingsError("--films names the files of every film; leave out --truth, --tracks and --detections")
        rows = list(_listed(args.films, general))
    elif args.truth is not None:
        rows = [_Row(args.truth.stem, args.truth, args.tracks, args.detections, general)]
    else:
        raise SettingsError("no truth is given; give --truth, or --films")
    for what, given in (("tracks", [row.tracks for row in rows]), ("detections", [row.detections for row in rows])):
        if any(given) and not all(given):
            film = rows[[bool(path) for path in given].index(False)].name
            raise InvalidInputError(f"film {film} has no {what} while others have; give {what} for all films or none")
    if not rows[0].tracks and not rows[0].detections:
        raise SettingsError("nothing is given to compare with the truth; give --tracks, --detections or both")
    return [_read(row) for row in rows]


def _read(row: _Row) -> FilmData:
    truth = read_tracks(row.truth, row.calibration)
    tracks = None if row.tracks is None else read_tracks(row.tracks, row.calibration)
    known = [truth.calibration] + ([] if tracks is None else [tracks.calibration])
    return FilmData(
        row.name,
        truth,
        tracks,
        None if row.detections is None else read_detections(row.detections),
        Calibration(
            next((c.pixel_size_um for c in known if c.pixel_size_um), None),
            next((c.frame_interval_seconds for c in known if c.frame_interval_seconds), None),
        ),
    )


def _listed(path: Path, general: Calibration) -> Iterable[_Row]:
    reader = csv.DictReader(io.StringIO(read_text(path)))
    unknown = set(reader.fieldnames or []) - set(_LIST_COLUMNS)
    missing = {"film", "truth"} - set(reader.fieldnames or [])
    if unknown or missing:
        wrong = f"has no column {sorted(missing)[0]}" if missing else f"has the unknown column {sorted(unknown)[0]}"
        raise InvalidInputError(f"{path} {wrong}; expected {', '.join(_LIST_COLUMNS)}")
    names = set()
    for line, row in enumerate(reader, start=2):
        if None in row or None in row.values() or not row["film"] or not row["truth"] or row["film"] in names:
            raise InvalidInputError(f"line {line} of {path} has no film, no truth, a film named before, or extra cells")
        names.add(row["film"])
        files = {what: path.parent / row[what] if row.get(what) else None for what in ("tracks", "detections")}
        numbers = [_cell(row.get(column), line, path) for column in ("pixel_size_um", "frame_interval_s")]
        calibration = Calibration(numbers[0] or general.pixel_size_um, numbers[1] or general.frame_interval_seconds)
        yield _Row(row["film"], path.parent / row["truth"], files["tracks"], files["detections"], calibration)
    if not names:
        raise InvalidInputError(f"{path} lists no film; add a row for each")


def _cell(word: str | None, line: int, path: Path) -> float | None:
    if not word:
        return None
    try:
        return _positive(word)
    except argparse.ArgumentTypeError as error:
        raise InvalidInputError(f"line {line} of {path}: {error}") from None


def _curves(films: list[FilmData], options: Options) -> dict[str, list[CurvePoint]]:
    """A curve of each level's candidates and of all, where there are any."""
    sets: dict[str, list[CurvePoint]] = {}
    steps = [dict(candidate_steps(film.candidates)) for film in films if film.candidates is not None]
    for name in steps[0] if steps else ():
        pairs = [(film.truth, found[name]) for film, found in zip(films, steps, strict=True)]
        sets[name] = precision_recall_curve(pairs, options.criterion)
    return {name: curve for name, curve in sets.items() if curve}


def _min_length(frames: int) -> int:
    if frames < 1:
        raise SettingsError(f"--min-length is {frames}; give 1 or more frames")
    return frames


def _positive(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not (0 < value < math.inf):
        raise argparse.ArgumentTypeError(f"{word!r} is not a positive number")
    return value


def _share(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not 0 <= value <= 1:
        raise argparse.ArgumentTypeError(f"{word!r} is not a number from 0 to 1")
    return value
