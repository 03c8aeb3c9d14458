# SPDX-License-Identifier: GPL-3.0-or-later
"""`memtrack simulate`: films with exact truth."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import tifffile

from memtrack.cli.arguments import check_target
from memtrack.errors import InvalidInputError, SettingsError
from memtrack.formats.trackmate_writer import FilmFile
from memtrack.simulation.families import FAMILIES, draw_recipe
from memtrack.simulation.film import SimulatedFilm, simulate
from memtrack.tracks_io import write_tracks

TRUTH_SUFFIXES = (".csv", ".mdf", ".xml")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("output", type=Path, help="the film, a .tif; the truth is written beside it")
    parser.add_argument("--family", choices=sorted(FAMILIES), default="collagen", help="kind of medium")
    parser.add_argument("--seed", type=int, default=0, help="the same seed makes the same film")
    parser.add_argument("--frames", type=int, default=100)
    parser.add_argument("--width", type=int, default=660)
    parser.add_argument("--height", type=int, default=492)


def run(args: argparse.Namespace) -> int:
    """Writes OUTPUT.tif, and its truth as .csv, .xml (TrackMate) and .mdf (MTrackJ) of the same name.

    Raises:
        SettingsError: a size is out of range, or nothing can be written there.
    """
    for name, low, high in (("frames", 1, 20000), ("width", 32, 8192), ("height", 32, 8192), ("seed", 0, 2**31)):
        if not low <= getattr(args, name) <= high:
            raise SettingsError(f"--{name} is {getattr(args, name)}: give a number from {low} to {high}")
    if args.output.suffix.lower() not in (".tif", ".tiff"):
        raise SettingsError(f"{args.output} is no TIFF name: let it end in .tif")
    for path in (args.output, *(args.output.with_suffix(suffix) for suffix in TRUTH_SUFFIXES)):
        check_target(path)
    rng = np.random.default_rng(args.seed)
    recipe = draw_recipe(args.family, rng, width=args.width, height=args.height, frames=args.frames)
    made = simulate(recipe, args.seed)
    write(made, args.output)
    truth = made.truth
    print(f"{args.output}: {recipe.frames} frames, {len(truth.track_ids)} bacteria, {recipe.scene}, seed {args.seed}")
    return 0


def write(made: SimulatedFilm, path: Path) -> None:
    """Writes the film as an ImageJ TIFF with its calibration, and the truth beside it.

    Raises:
        InvalidInputError: a file cannot be written.
    """
    recipe = made.recipe
    partial = path.with_name(path.name + ".part")
    try:
        tifffile.imwrite(
            partial,
            made.film.frames,
            imagej=True,
            resolution=(1 / recipe.pixel_size_um, 1 / recipe.pixel_size_um),
            metadata={"axes": "TYX", "unit": "micron", "finterval": recipe.frame_interval_seconds, "tunit": "sec"},
        )
        partial.replace(path)
    except OSError as error:
        raise InvalidInputError(f"cannot write {path}: {error.strerror}; check the folder and its rights") from error
    finally:
        if partial.is_file():
            partial.unlink()
    image = FilmFile(path.resolve(), recipe.width, recipe.height, recipe.frames)
    for suffix in TRUTH_SUFFIXES:
        write_tracks(path.with_suffix(suffix), made.truth, film=image)
