# SPDX-License-Identifier: GPL-3.0-or-later
"""`memtrack detect`: one film into a table, with the settings of the contract and without a server."""

from __future__ import annotations

import argparse
import hashlib
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from memtrack import __version__
from memtrack.cli.arguments import check_target, positive, thresholds
from memtrack.detections import FilterCounts, Level
from memtrack.detections_io import files_of, write_detections
from memtrack.errors import SettingsError
from memtrack.film import Calibration, Film
from memtrack.libraries import engine_threads, library_versions
from memtrack.models import CRITERIA, ENGINES, Model, load_model
from memtrack.pipeline import caveats, detect_film
from memtrack.progress import ProgressClock, Stage, StageCosts, Standing
from memtrack.settings import DetectionSettings
from memtrack.video import open_film
from memtrack.video.source import decode, grey


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of the subcommand; each default is the one of DetectionSettings."""
    default = DetectionSettings()
    add = parser.add_argument
    add("film", type=Path, help="TIFF, AVI, or folder with one image a frame")
    add("--out", type=Path, required=True, help="detections.csv or detections.json")
    add("--model", default=default.model, help="name, or name@version (default: %(default)s)")
    add("--criterion", choices=[c.replace("_", "-") for c in CRITERIA], default=default.criterion.replace("_", "-"),
        help="which of the model's thresholds to use (default: %(default)s)")  # fmt: skip
    add("--thresholds", metavar="LOW,MEDIUM,HIGH", help="lowest score kept a level, instead")
    add("--max-size-px", type=float, default=default.max_size_px, help="greatest box at the model's scale, more "
        "than all boxes of the model have, 30 in those shipped (default: %(default)s)")  # fmt: skip
    add("--nms-iou", type=float, default=default.nms_iou, help="greatest overlap (default: %(default)s)")
    add("--no-stabilisation", action="store_true", help="do not undo the drift of the stage")
    add("--resting", action="store_true", help="find bacteria that never move, too, and debris like them")
    add("--region", type=Path, help="image of the film's size; detections are reported where it is not black")
    add("--cell-length-px", type=positive, help="length of a cell in this film, pixels")
    add("--pixel-size-um", type=positive, help="edge of a pixel, um (default: what the film says)")
    add("--frame-interval-s", type=positive, help="time between frames, s (default: what the film says)")
    add("--engine", choices=ENGINES, default=default.engine, help="what runs the net (default: %(default)s)")
    add("--threads", type=int, default=engine_threads(), help="threads of the net (default here: %(default)s)")
    add("--quiet", action="store_true", help="no progress")


def run(options: argparse.Namespace) -> int:
    """Detects and writes; nothing is written unless the whole film went through."""
    for file in files_of(options.out):
        check_target(file)
    settings = _settings(options)
    model = load_model(settings.model, settings.version)
    settings.pruner(model.card)  # refused before the film is read, if at all
    with open_film(options.film, Calibration(options.pixel_size_um, options.frame_interval_s)) as film:
        notes = [*film.notes, *caveats(film, model, settings)]
        _say(notes)
        line = _ProgressLine(film.frame_count, quiet=options.quiet)
        film_sha256 = _sha256(film, line)
        learned: list[str] = []
        used = [model]
        frames = list(detect_film(film, model, settings, line.report, learned.append, used.append))
        line.end()
        _say(learned)
        counts = sum((found.counts for found in frames), FilterCounts())
        provenance = _provenance(options.film, film, [*notes, *learned], film_sha256, used[-1], settings, counts)
    for file in write_detections(options.out, frames, provenance):
        print(file)
    print(summary(counts, used[-1], settings), file=sys.stderr)
    return 0


def _say(notes: Iterable[str]) -> None:
    for note in notes:
        print(f"Note: {note}", file=sys.stderr)


def summary(counts: FilterCounts, model: Model, settings: DetectionSettings) -> str:
    """What was found, never a bare zero."""
    lowest = settings.pruner(model.card).thresholds
    return (
        f"{counts.kept} detections kept; of {counts.candidates} candidates above {model.card.decoder.floor:g}, "
        f"{counts.too_large} were too large, {counts.near_misses} below the thresholds "
        f"{', '.join(f'{t:g}' for t in lowest)}, {counts.overlapping} overlapped a better one, "
        f"{counts.outside_region} lay outside the region."
    )


def _settings(options: argparse.Namespace) -> DetectionSettings:
    name, _, version = options.model.partition("@")
    return DetectionSettings(
        model=name,
        version=version or None,
        criterion=options.criterion.replace("-", "_"),
        thresholds=None if options.thresholds is None else thresholds(options.thresholds),
        max_size_px=options.max_size_px,
        nms_iou=options.nms_iou,
        stabilise=not options.no_stabilisation,
        resting=options.resting,
        region=None if options.region is None else _region(options.region),
        cell_length_px=options.cell_length_px,
        engine=options.engine,
        threads=options.threads,
    )


def _region(path: Path) -> np.ndarray:
    try:
        return grey(decode(path.read_bytes(), path.name)) > 0
    except OSError as error:
        raise SettingsError(
            f"cannot read the region {path}: {error.strerror}; give an image of the film's size"
        ) from error


def _sha256(film: Film, line: _ProgressLine) -> str:
    """The same digest the server gives: all samples, little-endian, frame by frame."""
    digest = hashlib.sha256()
    for i in range(film.frame_count):
        frame = film.frame(i)
        digest.update(np.ascontiguousarray(frame, frame.dtype.newbyteorder("<")).tobytes())
        line.report(Stage.RECEIVING, i + 1, film.frame_count)
    return digest.hexdigest()


def _provenance(
    path: Path, film: Film, notes: list[str], film_sha256: str, model: Model, settings: DetectionSettings,
    counts: FilterCounts,
) -> dict[str, Any]:  # fmt: skip
    lowest = settings.pruner(model.card).thresholds
    shown = {name: getattr(settings, name) for name in settings.__slots__ if name != "region"}
    return {
        "memtrack": __version__,
        "libraries": library_versions(),
        "film": {
            "name": path.name,
            "sha256": film_sha256,
            "width": film.width,
            "height": film.height,
            "pixel_size_um": film.calibration.pixel_size_um,
            "frame_interval_seconds": film.calibration.frame_interval_seconds,
            "notes": notes,
        },
        "model": {"name": model.card.name, "version": model.card.version, "sha256": model.digest},
        "settings": {**shown, "region": settings.region is not None},
        "thresholds": {level.name.lower(): score for level, score in zip(Level, lowest, strict=True)},
        "counts": {name: getattr(counts, name) for name in counts.__slots__},
    }


class _ProgressLine:
    """One line on a terminal that says where the work stands."""

    def __init__(self, frame_count: int, *, quiet: bool) -> None:
        self._clock = ProgressClock(frame_count, StageCosts().current())
        self._shown = sys.stderr.isatty() and not quiet
        self._said = 0.0

    def report(self, stage: Stage, done: int, total: int) -> None:
        standing = self._clock.advance(stage, done, total)
        if self._shown and (time.monotonic() - self._said > 0.1 or done == total):
            self._said = time.monotonic()
            print(f"\r{_words(standing):<60}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self._shown:
            print(file=sys.stderr)


def _words(standing: Standing) -> str:
    left = "" if standing.seconds_left is None else f", {standing.seconds_left:.0f} s left"
    name = "reading" if standing.stage is Stage.RECEIVING else standing.stage.name.lower()
    return f"{standing.fraction:4.0%}  {name}: frame {standing.frames_done} of {standing.frames_total}{left}"
