# SPDX-License-Identifier: GPL-3.0-or-later
"""`memtrack evaluate`: truth against tracks and detections, of one film or of many."""

from __future__ import annotations

import argparse
import contextlib
from pathlib import Path

from memtrack.cli.arguments import make_folder, positive, share, thresholds
from memtrack.errors import SettingsError
from memtrack.evaluation import baselines
from memtrack.evaluation.curves import CurvePoint, precision_recall_curve
from memtrack.evaluation.evaluate import FilmData, Options, evaluate
from memtrack.evaluation.film_list import COLUMNS, FilmFiles, read_list
from memtrack.evaluation.matching import Criterion
from memtrack.evaluation.page import as_page
from memtrack.evaluation.report import Report, as_json, as_text
from memtrack.evaluation.stages import curve_sets
from memtrack.files import write_text
from memtrack.film import Calibration
from memtrack.pruning import PrunerSettings
from memtrack.settings import DetectionSettings
from memtrack.video.opening import open_film


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Describe the options of `memtrack evaluate`; the pruner's defaults are those of detection."""
    default = DetectionSettings()
    parser.add_argument("--truth", type=Path, help="the truth: CSV, .mdf of MTrackJ, .xml of TrackMate, or MOT .txt")
    parser.add_argument("--tracks", type=Path, help="the tracks to judge, in any of these formats")
    parser.add_argument(
        "--detections",
        type=Path,
        help="boxes, as `memtrack detect` writes them; for curves with --thresholds 0,0,0 --nms-iou 1",
    )
    parser.add_argument("--video", type=Path, help="the film itself, which --baselines work on")
    parser.add_argument(
        "--films",
        type=Path,
        help=f"instead of these four: a CSV with the columns {', '.join(COLUMNS)}, a row a film; "
        "paths start at its folder, and all but the first two may be missing or empty",
    )
    parser.add_argument(
        "--baselines",
        nargs="+",
        default=[],
        choices=baselines.NAMES,
        help="also run these detectors on the film, with the settings that suit this truth best",
    )
    parser.add_argument("--out", type=Path, required=True, help="folder for evaluation.html and evaluation.json")
    parser.add_argument("--iou", type=share, default=0.1, help="boxes match above this overlap (default 0.1)")
    parser.add_argument("--distance", type=positive, metavar="PX", help="match centres nearer than this instead")
    parser.add_argument(
        "--box-size", type=positive, default=30.0, metavar="PX", help="box of a row that has none (default 30)"
    )
    parser.add_argument(
        "--min-length", type=int, default=1, metavar="FRAMES", help="drop shorter tracks (default 1: keep all)"
    )
    parser.add_argument(
        "--challenge-gate",
        type=positive,
        metavar="PX",
        help="gate of alpha, beta, JSC and RMSE (default: --distance, or 5)",
    )
    parser.add_argument("--pixel-size-um", type=positive, help="edge of a pixel, where the files do not say")
    parser.add_argument("--frame-interval-s", type=positive, help="time between frames, where the files do not say")
    parser.add_argument(
        "--thresholds",
        metavar="LOW,MEDIUM,HIGH",
        help="score thresholds of the levels: follows the candidates through the pruner's filters",
    )
    parser.add_argument(
        "--max-size-px",
        type=positive,
        default=default.max_size_px,
        help="pruner: greatest edge of a box (default: %(default)s)",
    )
    parser.add_argument(
        "--nms-iou",
        type=share,
        default=default.nms_iou,
        help="pruner: greatest overlap of two boxes (default: %(default)s)",
    )


def run(args: argparse.Namespace) -> int:
    """Evaluate, write the page and the JSON, print the table.

    Raises:
        InvalidInputError: a file or an option cannot be used.
    """
    files = _files(args)
    pruner = None
    if args.thresholds is not None:
        pruner = PrunerSettings(thresholds(args.thresholds), args.max_size_px, args.nms_iou)
    options = Options(
        criterion=Criterion(args.iou, args.distance, args.box_size),
        min_length=_min_length(args.min_length),
        challenge_gate_px=args.challenge_gate or args.distance or 5.0,
        pruner=pruner,
    )
    films = [film.read() for film in files]
    report = Report(
        {film.name: evaluate(film, options) for film in films},
        _curves(films, options, args.max_size_px, args.nms_iou),
        options,
        _baselines(args.baselines, files, films, options),
    )
    make_folder(args.out, "--out")
    write_text(args.out / "evaluation.json", as_json(report))
    write_text(args.out / "evaluation.html", as_page(report))
    print(as_text(report))
    return 0


def _files(args: argparse.Namespace) -> list[FilmFiles]:
    general = Calibration(args.pixel_size_um, args.frame_interval_s)
    if args.films is not None:
        if args.truth or args.tracks or args.detections or args.video:
            raise SettingsError(
                "--films names the files of every film; leave out --truth, --tracks, --detections and --video"
            )
        files = read_list(args.films, general)
    elif args.truth is not None:
        files = [FilmFiles(args.truth.stem, args.truth, args.tracks, args.detections, args.video, general)]
    else:
        raise SettingsError("no truth is given; give --truth, or --films")
    if files[0].tracks is None and files[0].detections is None:
        raise SettingsError("nothing is given to compare with the truth; give tracks, detections or both")
    if args.baselines and not all(film.video for film in files):
        raise SettingsError("baselines work on the film itself; give --video, or the column video in --films")
    return files


def _curves(films: list[FilmData], options: Options, max_size_px: float, nms_iou: float) -> dict[str, list[CurvePoint]]:
    """A curve of each level's candidates and of all, where there are any."""
    sets = [curve_sets(film.candidates, max_size_px, nms_iou) for film in films if film.candidates is not None]
    curves = {}
    for name in sets[0] if sets else ():
        pairs = [(film.truth, found[name]) for film, found in zip(films, sets, strict=True)]
        curves[name] = precision_recall_curve(pairs, options.criterion)
    return {name: curve for name, curve in curves.items() if curve}


def _baselines(
    names: list[str], files: list[FilmFiles], films: list[FilmData], options: Options
) -> list[baselines.TunedBaseline]:
    """Each baseline at its best over all films."""
    with contextlib.ExitStack() as stack:
        opened = [
            (stack.enter_context(open_film(paths.video)), film.truth)
            for paths, film in zip(files, films, strict=True)
            if names and paths.video
        ]
        return [baselines.tune(name, opened, options.criterion) for name in names]


def _min_length(frames: int) -> int:
    if frames < 1:
        raise SettingsError(f"--min-length is {frames}; give 1 or more frames")
    return frames
