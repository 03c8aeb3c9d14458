# SPDX-License-Identifier: GPL-3.0-or-later
import ast
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import memtrack
from memtrack.errors import SettingsError
from memtrack.film import Calibration
from memtrack.motion import MOTION
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import simulate
from memtrack.tracks import Motility, TrackTable
from memtrack.training.films import _SHAPING, SimulatedSet, simulated_samples, with_motility
from memtrack.training.samples import extract


def test_samples_stand_on_the_grid_of_their_features() -> None:
    recipe = replace(
        draw_recipe("collagen", np.random.default_rng(5), width=160, height=160, frames=30),
        drift_per_frame=(0.2, -0.13),
        texture=15.0,
    )
    made = simulate(recipe, 1)
    got = extract(made.film, made.truth, MOTION, frames=6, rng=np.random.default_rng(0))
    assert got.features.shape == (6, len(MOTION.channels), 160, 160)
    assert sum(len(rows) for rows in got.truth) > 0


def test_cached_samples_are_read_back(tmp_path: Path) -> None:
    sets = [SimulatedSet("water", 2, 7, size=96, frames=3)]
    first = simulated_samples(sets, MOTION, tmp_path)
    stamps = {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*.npy")}
    again = simulated_samples(sets, MOTION, tmp_path)
    assert len(first) == len(again) == len(stamps) == 2
    assert {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*.npy")} == stamps
    np.testing.assert_array_equal(first[1].features, again[1].features)
    np.testing.assert_array_equal(first[1].truth[2], again[1].truth[2])


def test_samples_are_made_anew_when_any_code_they_are_made_by_has_changed() -> None:
    code = (
        "import sys, memtrack.training.samples, memtrack.simulation.film, memtrack.simulation.families\n"
        "modules = [m for name, m in sys.modules.items() if name.startswith('memtrack')]\n"
        "print([m.__file__ for m in modules if not m.__file__.endswith('__init__.py')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    package = Path(memtrack.__file__).parent
    used = {Path(file).relative_to(package).as_posix() for file in ast.literal_eval(done.stdout)}
    values = {"errors.py", "detections.py", "tracks.py"}
    assert used - values == set(_SHAPING) - {"training/films.py"}


def test_motility_is_measured_where_a_file_does_not_say_it() -> None:
    frames = np.arange(120)
    truth = TrackTable.of(
        np.tile(frames, 2),
        np.repeat([1, 2], 120),
        np.concatenate([frames * 1.5, np.full(120, 50.0)]),
        np.zeros(240),
        motility=np.repeat([Motility.UNKNOWN, Motility.MEDIUM], 120),
        calibration=Calibration(0.25, 1 / 60),
    )
    measured = with_motility(truth, "a.mdf")
    assert set(measured.motility[measured.ids == 1]) == {Motility.HIGH}
    assert set(measured.motility[measured.ids == 2]) == {Motility.MEDIUM}
    with pytest.raises(SettingsError, match=r"a\.mdf has bacteria without a motility class"):
        with_motility(replace(truth, calibration=Calibration()), "a.mdf")
