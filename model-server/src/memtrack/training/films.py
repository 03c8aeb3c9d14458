# SPDX-License-Identifier: GPL-3.0-or-later
"""The films of a training: simulated ones by family and seed, kept on disk as samples, and annotated ones of a user."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import shutil
import sys
import uuid
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from memtrack.errors import SettingsError
from memtrack.film import Calibration
from memtrack.motility import motility_of, peak_diffusivity
from memtrack.motion import FeatureSpec
from memtrack.pipeline import mended
from memtrack.resampling import factors_of, scaled
from memtrack.scale import scale_to
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import simulate
from memtrack.tracks import Motility, TrackTable
from memtrack.tracks_io import read_tracks
from memtrack.training.samples import FilmSamples, extract
from memtrack.video.opening import OpenedFilm, open_film


@dataclass(frozen=True, slots=True)
class Annotated:
    """A user's film and its tracks (.mdf, .xml, .csv); `role` is 'training' or 'validation': films are never split.

    pixel_size_um, frame_interval_seconds: 0 where the film's file says it. frames: how many of its frames are used.
    """

    film: str
    tracks: str
    role: str = "training"
    pixel_size_um: float = 0.0
    frame_interval_seconds: float = 0.0
    frames: int = 60


@dataclass(frozen=True, slots=True)
class SimulatedSet:
    """Films of one family: `count` films of `size` x `size` pixels from `seed` on, `frames` frames kept of each."""

    family: str
    count: int
    seed: int
    size: int = 320
    frames: int = 10


def simulated_samples(
    sets: Sequence[SimulatedSet],
    spec: FeatureSpec,
    cache: Path,
    *,
    workers: int = 1,
    report: Callable[[int, int], None] = lambda done, total: None,
) -> list[FilmSamples]:
    """Samples of every film of `sets`; those made before, for the same set, spec and code, are read from `cache`.

    Features are mapped from disk, so that a training needs little memory.
    """
    jobs = [(s, k, spec, cache) for s in sets for k in range(s.count)]
    paths = []
    # Python on Windows cannot wait for more.
    processes = min(workers, 61) if sys.platform == "win32" else workers
    with ProcessPoolExecutor(processes) as pool:
        for done, path in enumerate(map(_make, jobs) if workers == 1 else pool.map(_make, jobs, chunksize=4)):
            paths.append(path)
            report(done + 1, len(jobs))
    return [_load(path, job[0].family) for path, job in zip(paths, jobs, strict=True)]


def check_annotated(films: Sequence[Annotated], base: Path) -> None:
    """Opens each film and reads its tracks, to find at once what `annotated_samples` would find after hours.

    Raises:
        InvalidInputError, SettingsError: see `annotated_samples`.
    """
    for entry in films:
        with _opened(entry, base):
            pass


def annotated_samples(
    films: Sequence[Annotated], spec: FeatureSpec, cell_length_px: tuple[float, float], base: Path, *, seed: int
) -> list[FilmSamples]:
    """Samples of a user's films; paths are relative to `base`, the recipe's folder.

    A film is mended and brought to the model's scale as in detection: one whose bacteria are longer or shorter than
    `cell_length_px` is brought to that range. Bacteria without a class get one from the motility of their track.

    Raises:
        InvalidInputError: a film or its tracks cannot be read.
        SettingsError: tracks without a class in a film without a pixel size or frame interval.
    """
    made = []
    for number, entry in enumerate(films):
        with _opened(entry, base) as (film, truth):
            scale = scale_to(cell_length_px, film.calibration)
            whole = mended(film)
            at_scale = scaled(whole, scale)
            across, down = factors_of(whole, at_scale)
            truth = replace(truth, x=(truth.x + 0.5) * across - 0.5, y=(truth.y + 0.5) * down - 0.5)
            rng = np.random.default_rng([seed, number])
            made.append(extract(at_scale, truth, spec, frames=entry.frames, rng=rng, family=Path(entry.film).stem))
    return made


@contextlib.contextmanager
def _opened(entry: Annotated, base: Path) -> Iterator[tuple[OpenedFilm, TrackTable]]:
    given = Calibration(entry.pixel_size_um or None, entry.frame_interval_seconds or None)
    with open_film(base / entry.film, given) as film:
        yield film, with_motility(read_tracks(base / entry.tracks, film.calibration), entry.tracks)


def with_motility(truth: TrackTable, name: str) -> TrackTable:
    """`truth` with the motility of its tracks measured where a row has none."""
    if not (truth.motility == Motility.UNKNOWN).any():
        return truth
    if truth.calibration.pixel_size_um is None or truth.calibration.frame_interval_seconds is None:
        raise SettingsError(
            f"{name} has bacteria without a motility class, which needs the film's scale to be measured: give "
            "pixel_size_um and frame_interval_seconds in the recipe"
        )
    motility = truth.motility.copy()
    for track in truth.tracks():
        measured = motility_of(peak_diffusivity(track, truth.calibration))
        rows = (truth.ids == track.ids[0]) & (truth.motility == Motility.UNKNOWN)
        motility[rows] = Motility.NONE if measured is Motility.UNKNOWN else measured
    return replace(truth, motility=motility)


def _make(job: tuple[SimulatedSet, int, FeatureSpec, Path]) -> Path:
    films, k, spec, cache = job
    path = cache / f"{_key(films, spec)}-{films.seed + k}"
    if path.is_dir():
        return path
    rng = np.random.default_rng([films.seed + k, _number(films.family)])
    recipe = draw_recipe(films.family, rng, width=films.size, height=films.size)
    made = simulate(recipe, int(rng.integers(2**31)))
    stabilise = bool(made.drift.any()) or rng.random() < 0.5
    samples = extract(made.film, made.truth, spec, frames=films.frames, rng=rng, stabilise=stabilise)
    partial = path.with_name(f"{path.name}.{uuid.uuid4().hex}")
    try:
        partial.mkdir(parents=True)
        np.save(partial / "features.npy", samples.features)
        counts = np.array([len(rows) for rows in samples.truth])
        np.savez(partial / "truth.npz", rows=np.concatenate(samples.truth), counts=counts)
        os.replace(partial, path)
    except BaseException as error:
        shutil.rmtree(partial, ignore_errors=True)
        # Another training in this workspace may have made the same film meanwhile.
        if not (isinstance(error, OSError) and path.is_dir()):
            raise
    return path


def _load(path: Path, family: str) -> FilmSamples:
    features = np.load(path / "features.npy", mmap_mode="r")
    with np.load(path / "truth.npz") as stored:
        rows = np.split(stored["rows"], np.cumsum(stored["counts"])[:-1])
    return FilmSamples(features, tuple(rows), family)


def _number(family: str) -> int:
    return int.from_bytes(hashlib.sha256(family.encode()).digest()[:4], "little")


def _key(films: SimulatedSet, spec: FeatureSpec) -> str:
    code = hashlib.sha256()
    for source in _SHAPING:
        code.update((Path(__file__).parents[1] / source).read_bytes())
    what = json.dumps([films.family, films.size, films.frames, asdict(spec)])
    return f"{films.family}-{hashlib.sha256(code.digest() + what.encode()).hexdigest()[:12]}"


_SHAPING = (
    "simulation/film.py",
    "simulation/recipe.py",
    "simulation/families.py",
    "simulation/scenes.py",
    "simulation/swimming.py",
    "simulation/optics.py",
    "simulation/bacteria.py",
    "simulation/truth.py",
    "simulation/variations.py",
    "simulation/captions.py",
    "simulation/passing.py",
    "simulation/processing.py",
    "training/films.py",
    "training/samples.py",
    "film.py",
    "lookahead.py",
    "registration.py",
    "cuts.py",
    "stabilisation.py",
    "background.py",
    "fixed_pattern.py",
    "leavers.py",
    "clouds.py",
    "wobble.py",
    "spots.py",
    "tethered.py",
    "resting.py",
    "windows.py",
    "scene.py",
    "channels.py",
    "motion.py",
    "flow.py",
    "resampling.py",
    "motility.py",
)
"""Source files that change what a sample holds."""
