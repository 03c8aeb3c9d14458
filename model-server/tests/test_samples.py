# SPDX-License-Identifier: GPL-3.0-or-later
import ast
import errno
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import tifffile

import memtrack
from memtrack import nets
from memtrack.channels import Channel
from memtrack.defects import without_defects
from memtrack.detector import padded
from memtrack.errors import SettingsError
from memtrack.film import ArrayFilm, Calibration
from memtrack.models import load_model
from memtrack.motion import MOTION
from memtrack.pipeline import detect_film
from memtrack.settings import DetectionSettings
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import simulate
from memtrack.tracks import Motility, TrackTable
from memtrack.tracks_io import write_tracks
from memtrack.training.films import (
    _SHAPING,
    Annotated,
    SimulatedSet,
    annotated_samples,
    simulated_samples,
    with_motility,
)
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


def test_what_a_training_that_broke_off_left_is_no_hindrance(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sets = [SimulatedSet("water", 1, 7, size=96, frames=3)]
    simulated_samples(sets, MOTION, tmp_path)
    (made,) = tmp_path.iterdir()
    shutil.move(made, tmp_path / f"{made.name}.{os.getpid()}")  # its process had the number of ours
    assert len(simulated_samples(sets, MOTION, tmp_path)) == 1
    shutil.rmtree(made)

    def full(path: Path, features: np.ndarray) -> None:
        path.write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(np, "save", full)
    with pytest.raises(OSError, match="No space left"):
        simulated_samples(sets, MOTION, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == [f"{made.name}.{os.getpid()}"]


def test_a_film_that_another_training_has_made_meanwhile_is_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sets = [SimulatedSet("water", 1, 7, size=96, frames=3)]
    save = np.save

    def slowly(path: Path, features: np.ndarray) -> None:
        monkeypatch.undo()
        simulated_samples(sets, MOTION, tmp_path)
        save(path, features)

    monkeypatch.setattr(np, "save", slowly)
    assert len(simulated_samples(sets, MOTION, tmp_path)) == 1
    assert len(list(tmp_path.iterdir())) == 1


def test_more_workers_than_windows_can_wait_for_are_not_started(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert simulated_samples([], MOTION, tmp_path, workers=100) == []


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


def test_an_annotated_film_has_the_features_that_detection_sees(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a camera with stuck pixels, a bar at the side, and a stage that drifts them over the scene."""
    recipe = draw_recipe("collagen", np.random.default_rng(5), width=128, height=96, frames=24)
    made = simulate(replace(recipe, bits=8, drift_per_frame=(0.4, -0.3), scale=1.0, pixel_size_um=0.2475), 1)
    frames = made.film.frames.copy()
    frames[:, [12, 50, 71], [60, 77, 90]] = 255
    frames[:, :, :20] = 0
    assert without_defects(ArrayFilm(frames)).frame(0)[12, 60] < 255
    tifffile.imwrite(tmp_path / "film.tif", frames)
    write_tracks(tmp_path / "film.csv", made.truth)
    model, shown = replace(load_model(), crowds=None), list[np.ndarray]()
    entry = Annotated("film.tif", "film.csv", pixel_size_um=0.2475, frame_interval_seconds=1 / 60)
    (samples,) = annotated_samples([entry], model.card.features, model.card.cell_length_px, tmp_path, seed=1)

    def listening(channels: list[Channel]) -> np.ndarray:
        shown.append(np.stack(channels))
        return padded(channels)

    monkeypatch.setattr(nets, "padded", listening)
    film = ArrayFilm(frames, Calibration(0.2475, 1 / 60))
    list(detect_film(film, model, DetectionSettings(threads=1), lambda stage, done, total: None))
    np.testing.assert_array_equal(samples.features, np.stack(shown))
