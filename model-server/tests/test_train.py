# SPDX-License-Identifier: GPL-3.0-or-later
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import tifffile
import torch

from memtrack.errors import InvalidInputError, ModelNotFoundError, SettingsError
from memtrack.models import load_model
from memtrack.motion import MOTION
from memtrack.training.config import ModelSettings, Optimisation, TrainingConfig
from memtrack.training.figures import LOSSES
from memtrack.training.films import Annotated, SimulatedSet
from memtrack.training.optimise import Workspace, optimise
from memtrack.training.recipe import summary, train
from memtrack.training.samples import FilmSamples
from memtrack.training.thresholds import Scored
from spots import samples


def small_training() -> tuple[TrainingConfig, list[FilmSamples]]:
    """A training of a few seconds' work that leaves a checkpoint of iteration 3."""
    films = [samples([[20, 37, 0, 0], [40, 12, 2, 0]])]
    channels = len(MOTION.channels)
    films = [replace(films[0], features=np.repeat(films[0].features, 5, axis=1)[:, :channels])]
    model = ModelSettings("a", widths=(4, 4, 4, 4), depths=(1, 1, 1))
    steps = Optimisation(iterations=6, batch=2, crop=48, warm_up=2, checkpoint_every=3, bfloat16=False)
    simulated = (SimulatedSet("water", 1, 1),), (SimulatedSet("water", 1, 2),)
    return TrainingConfig(model, *simulated, optimisation=steps), films


def silent(line: str) -> None:
    pass


def test_a_missing_model_to_start_from_is_said_before_films_are_made(tmp_path: Path) -> None:
    config, _ = small_training()
    config = replace(config, model=replace(config.model, start_from="nobody"))
    workspace = Workspace(tmp_path)
    with pytest.raises(ModelNotFoundError, match="there is no model nobody"):
        train(config, workspace, tmp_path, base=tmp_path, device="cpu", workers=1, report=silent)
    assert not workspace.samples.exists()


def test_an_annotated_film_that_cannot_be_used_is_said_before_films_are_made(tmp_path: Path) -> None:
    config, _ = small_training()
    tifffile.imwrite(tmp_path / "a.tif", np.zeros((3, 32, 32), np.uint8), photometric="minisblack")
    workspace = Workspace(tmp_path / "work")

    def refused(film: str, tracks: str) -> str:
        entries = Annotated("a.tif", "a.csv"), Annotated(film, tracks, role="validation")
        annotated = replace(config, annotated=entries)
        with pytest.raises(InvalidInputError) as caught:
            train(annotated, workspace, tmp_path, base=tmp_path, device="cpu", workers=1, report=silent)
        assert not workspace.samples.exists()
        return str(caught.value)

    (tmp_path / "a.csv").write_text("track,frame,x,y,motility\n0,0,5,5,low\n", encoding="utf-8")
    (tmp_path / "b.csv").write_text("track,frame,x,y\n0,0,5,5\n", encoding="utf-8")
    assert "there is no film" in refused("missing.tif", "a.csv")
    assert "cannot read" in refused("a.tif", "missing.csv")
    assert "b.csv has bacteria without a motility class" in refused("a.tif", "b.csv")


def test_figures_of_a_model_that_finds_nothing_right_are_json() -> None:
    nothing = np.full(3, -1)
    wrong = np.array([0.9, 0.5, 0.2], np.float32), np.zeros(3, int), np.zeros(3, bool), np.full(3, np.nan), nothing
    model = load_model()
    card = summary(Scored(*wrong, np.array([4, 0, 0]), 2), [], model.engine(), model.card.decoder)
    assert card["centre_rms_px"] is None
    assert json.loads(json.dumps(card, allow_nan=False))["f1"] == 0


def test_a_loss_that_is_no_number_ends_the_training_at_once(tmp_path: Path) -> None:
    config, films = small_training()
    steps = replace(config.optimisation, learning_rate=1e30)
    said: list[str] = []
    with pytest.raises(
        SettingsError, match=r"the loss is no number after iteration \d+: lower learning_rate in \[optim"
    ):
        optimise(replace(config, optimisation=steps), films, Workspace(tmp_path), "cpu", said.append)
    assert said == []


def test_an_interrupted_training_goes_on_to_the_same_weights(tmp_path: Path) -> None:
    config, films = small_training()
    workspace = Workspace(tmp_path)
    whole = optimise(config, films, workspace, "cpu", silent).state_dict()
    assert workspace.checkpoint.is_file()
    resumed = optimise(config, films, workspace, "cpu", silent).state_dict()
    assert set(whole) == set(resumed)
    for name, value in whole.items():
        torch.testing.assert_close(value, resumed[name])


def test_the_loss_curve_of_a_resumed_training_has_each_iteration_once(tmp_path: Path) -> None:
    config, films = small_training()
    losses = tmp_path / LOSSES
    losses.write_text("of a training before\n9,1,1\n")
    optimise(config, films, Workspace(tmp_path), "cpu", silent)
    header, last = losses.read_text().splitlines()
    losses.write_text(f"{header}\n2,0.5,0.001\n3,0.4,0.001\n5,0.3,0.001\n")  # interrupted after its checkpoint of 3
    optimise(config, films, Workspace(tmp_path), "cpu", silent)
    first, second, third = losses.read_text().splitlines()[1:]
    assert [first, second] == ["2,0.5,0.001", "3,0.4,0.001"]
    assert third.split(",")[0] == last.split(",")[0] == "6"


def test_a_checkpoint_of_another_recipe_is_refused_before_films_are_made(tmp_path: Path) -> None:
    config, films = small_training()
    workspace = Workspace(tmp_path)
    optimise(config, films, workspace, "cpu", silent)
    other = replace(config, training=(SimulatedSet("water", 2, 1),))
    with pytest.raises(SettingsError, match=r"checkpoint\.pt is of a training by another recipe; delete it, or give"):
        train(other, workspace, tmp_path, base=tmp_path, device="cpu", workers=1, report=silent)
    assert not workspace.samples.exists()


def test_a_training_from_the_start_begins_its_curve_anew(tmp_path: Path) -> None:
    config, films = small_training()
    workspace = Workspace(tmp_path)
    for _ in range(2):
        optimise(config, films, workspace, "cpu", silent)
        workspace.checkpoint.unlink()
    assert len((tmp_path / "loss.csv").read_text(encoding="utf-8").splitlines()) == 2
