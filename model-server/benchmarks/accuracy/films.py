# SPDX-License-Identifier: GPL-3.0-or-later
"""The films: a fixed list of simulated ones, whose seeds no recipe uses, and on request the real ones of a folder."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from memtrack.cli.simulate import write
from memtrack.film import Calibration, Film
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import SimulatedFilm, simulate
from memtrack.tracks import TrackTable
from memtrack.tracks_io import read_tracks
from memtrack.video.opening import open_film

FIRST_SEED = 5_000_000
"""The seeds of all films are this and the numbers after it; training and validation use others."""

STILL: dict[str, Any] = {
    "drift_per_frame": (0.0, 0.0),
    "jitter": 0.0,
    "jump": 0.0,
    "flicker": 0.0,
    "lamp_drift": 0.0,
    "wobble": 0.0,
    "restless": 0.0,
}
MOVING = STILL | {"drift_per_frame": (0.05, -0.03), "jitter": 0.1, "flicker": 0.02}
DRIFTING = {"drift_per_frame": (0.05, -0.03)}


@dataclass(frozen=True, slots=True)
class Made:
    """A film as it is examined: the file, its frames, its truth, the preset and further options to track it with."""

    name: str
    shows: str
    path: Path
    film: Film
    truth: TrackTable
    preset: str
    options: str = ""

    @property
    def least_lengths(self) -> tuple[int, int]:
        """Frames a track must span by the preset, 60 in collagen and 30 in water, at most half the film; half that."""
        longest = min(30 if self.preset == "water" else 60, self.film.frame_count // 2)
        return longest, longest // 2


@dataclass(frozen=True, slots=True)
class Simulated:
    """A film to simulate: seeds from `first_seed` + `number` on; `cells` redraws until about so many are there.

    changes: of the recipe, after it was drawn.
    """

    name: str
    family: str
    number: int
    cells: int | None = None
    changes: dict[str, Any] = field(default_factory=dict)
    size: tuple[int, int] = (660, 492)
    frames: int = 100
    first_seed: int = FIRST_SEED

    def seeds(self) -> Iterator[int]:
        """Those tried for the recipe, in order; the first one also draws everything else."""
        return itertools.count(self.first_seed + self.number, 1000)

    def simulate(self) -> SimulatedFilm:
        """The film and its truth, the same every time."""
        for seed in self.seeds():
            width, height = self.size
            recipe = draw_recipe(
                self.family, np.random.default_rng(seed), width=width, height=height, frames=self.frames
            )
            if self.cells is None or abs(len(recipe.gaits) - self.cells) < 0.25 * self.cells:
                return simulate(replace(recipe, **self.changes), self.first_seed + self.number)
        raise AssertionError("seeds never end")

    @contextmanager
    def made(self, folder: Path) -> Iterator[Made]:
        """The film, written to `folder`."""
        simulated = self.simulate()
        path = folder / f"{self.name}.tif"
        write(simulated, path)
        preset = "water" if self.family == "water" else "collagen"
        yield Made(self.name, _words(self.family, simulated), path, simulated.film, simulated.truth, preset)


def _words(family: str, film: SimulatedFilm) -> str:
    """The scene and how far it moved: "mottled collagen, drifts 5 px"."""
    scene = film.recipe.scene
    words = scene if family == scene else f"{scene} {'scene' if family == 'empty' else family}"
    reach = float(np.abs(film.drift).max())
    return f"{words}, drifts {reach:.0f} px" if reach >= 1 else words


def _both(name: str, number: int) -> list[Simulated]:
    """One dense film twice: nothing but the cells moves, and with drift, jitter and flicker."""
    return [
        Simulated(name, "collagen", number, 45, STILL),
        Simulated(f"{name}mov", "collagen", number, 45, MOVING),
    ]


SIMULATED = (
    *_both("dense1", 1),
    *_both("dense2", 2),
    *_both("dense16", 16),
    *(Simulated(f"coll{n}", "collagen", n) for n in (3, 4, 5)),
    *(Simulated(f"foam{n}", "foam", n) for n in (6, 7)),
    *(Simulated(f"gran{n}", "granular", n) for n in (17, 18)),
    *(Simulated(f"crowd{n}", "water", n, 80) for n in (8, 9)),
    *(Simulated(f"water{n}", "water", n) for n in (10, 11)),
    *(Simulated(f"empty{n}", "empty", n, None, DRIFTING) for n in (12, 13, 14, 15)),
)


@dataclass(frozen=True, slots=True)
class Real:
    """A real film with tracks, in the folder of real films; these are looked at and never tuned on."""

    name: str
    shows: str
    video: str
    truth: str
    preset: str
    calibration: Calibration

    @contextmanager
    def made(self, folder: Path) -> Iterator[Made]:
        """The film where it is in `folder`."""
        c = self.calibration
        options = f"pixel_size={c.pixel_size_um} frame_interval={c.frame_interval_seconds}"
        with open_film(folder / self.video) as film:
            truth = read_tracks(folder / self.truth, c)
            yield Made(self.name, self.shows, folder / self.video, film, truth, self.preset, options)


REAL = (
    Real(
        "collagen_transplant",
        "real cells set into a real still",
        "collagen_transplant/collagen_agar1_transplant",
        "collagen_transplant/collagen_agar1_transplant_tracks.csv",
        "collagen",
        Calibration(0.2475, 0.016667),
    ),
    Real(
        "bacteria_water",
        "real swimmers in water",
        "bacteria_water/bacteria_water_TL.tif",
        "bacteria_water/bacteria_water_TL_silver_tracks.csv",
        "water",
        Calibration(0.4545, 0.037216),
    ),
)
