# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how well the whole method tracks films that no training and no tuning has seen.

    python3 build.py accuracy [--data FOLDER] [--peers] [--trackmate CLASSPATH] [--films NAME ...] [--first-seed N]

Every film goes through headless ImageJ, the plug-in's jar, a real server, SORT and the CSV, with the default settings
and the preset of its medium. Prints the tables of docs/comparison.md, and keeps all numbers in docs/comparison.json,
where scores of methods that are not run stay as long as film and truth are the same.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
RESULTS = ROOT / "model-server" / "docs" / "comparison.json"
sys.path[:0] = [str(ROOT), str(ROOT / "model-server" / "benchmarks")]

import build  # noqa: E402

from accuracy import peers  # noqa: E402
from accuracy.films import FIRST_SEED, REAL, SIMULATED, Made, Real, Simulated  # noqa: E402
from accuracy.scores import OURS, Examined, Scores, score, tables  # noqa: E402
from memtrack.files import write_text  # noqa: E402
from memtrack.tracks_io import read_tracks  # noqa: E402


def main() -> int:
    """Runs the command line; 0 when every film was tracked."""
    parser = argparse.ArgumentParser(
        prog="build.py accuracy", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, help="folder of the two real films and their tracks, looked at too")
    parser.add_argument("--peers", action="store_true", help="LoG and trackpy too, tuned on the truth of each film")
    parser.add_argument("--trackmate", metavar="CLASSPATH", help="TrackMate 8 too, tuned likewise; its Java class path")
    parser.add_argument("--skip-ours", action="store_true", help="run the others alone")
    parser.add_argument("--films", nargs="+", metavar="NAME", help="only these (default: all)")
    parser.add_argument(
        "--first-seed",
        type=int,
        default=FIRST_SEED,
        metavar="N",
        help="draws the simulated films from other seeds (default: %(default)s)",
    )
    parser.add_argument("--output", type=Path, default=ROOT / "out" / "accuracy", help="default: out/accuracy")
    parser.add_argument(
        "--results",
        type=Path,
        help="default: model-server/docs/comparison.json, or of films drawn anew a file in the output folder",
    )
    arguments = parser.parse_args()
    if arguments.first_seed < 0:
        parser.error(f"--first-seed is {arguments.first_seed}; give a whole number from 0 on")
    anew = arguments.output / f"comparison-{arguments.first_seed}.json"
    arguments.results = arguments.results or (RESULTS if arguments.first_seed == FIRST_SEED else anew)
    simulated = [replace(film, first_seed=arguments.first_seed) for film in SIMULATED]
    chosen: list[Simulated | Real] = [*simulated, *(REAL if arguments.data else ())]
    if unknown := set(arguments.films or ()) - {film.name for film in chosen}:
        parser.error(f"there is no film {min(unknown)}; choose from {', '.join(film.name for film in chosen)}")
    arguments.output.mkdir(parents=True, exist_ok=True)
    films = read(arguments.results)
    for film in chosen:
        if not arguments.films or film.name in arguments.films:
            folder = arguments.data if isinstance(film, Real) else arguments.output
            with film.made(folder) as made:
                films[film.name] = examine(made, films.get(film.name), arguments)
            write(arguments.results, films)
    order = [film.name for film in (*SIMULATED, *REAL)]
    print(tables(sorted(films.values(), key=lambda film: order.index(film.name))), end="")
    return 0


def examine(film: Made, before: Examined | None, arguments: argparse.Namespace) -> Examined:
    """The film with the scores of the methods that are asked for, and with those it had before."""
    fingerprint = fingerprint_of(film)
    scores = dict(before.scores) if before is not None and before.fingerprint == fingerprint else {}
    if not arguments.skip_ours:
        print(f"== {film.name}", file=sys.stderr, flush=True)
        build.in_imagej(film.path, arguments.output / film.name, f"preset={film.preset} {film.options}")
        results = arguments.output / film.name / film.path.stem
        model = json.loads(results.with_suffix(".json").read_text(encoding="utf-8"))["model"]
        tracks = read_tracks(results.with_suffix(".csv"))
        scores[OURS] = score(film.truth, tracks, f"model {model['name']} {model['version']}")
    counted = int((~film.truth.ignored).sum())
    if counted and arguments.peers:
        scores |= peers.spot_detectors(film)
    if counted and arguments.trackmate:
        scores |= peers.trackmate(film, arguments.trackmate, arguments.output / film.name)
    return Examined(film.name, film.shows, counted / film.film.frame_count, fingerprint, scores)


def fingerprint_of(film: Made) -> str:
    """Of the pixels and the truth."""
    content = hashlib.sha256()
    for index in range(film.film.frame_count):
        content.update(np.ascontiguousarray(film.film.frame(index)).tobytes())
    for column in (film.truth.frames, film.truth.ids, film.truth.x, film.truth.y, film.truth.ignored):
        content.update(column.tobytes())
    return content.hexdigest()[:16]


def read(path: Path) -> dict[str, Examined]:
    """The films of an earlier run, by name; none if there was none."""
    if not path.is_file():
        return {}
    films = json.loads(path.read_text(encoding="utf-8"))
    return {
        name: Examined(**{**film, "scores": {method: Scores(**values) for method, values in film["scores"].items()}})
        for name, film in films.items()
    }


def write(path: Path, films: dict[str, Examined]) -> None:
    """Everything that was measured; NaN where there is nothing to measure."""
    write_text(path, json.dumps({name: asdict(film) for name, film in films.items()}, indent=1) + "\n")


if __name__ == "__main__":
    sys.exit(main())
