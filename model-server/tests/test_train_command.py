# SPDX-License-Identifier: GPL-3.0-or-later
import argparse
import errno
import os
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile
import torch

from memtrack.channels import NEUTRAL
from memtrack.cli import models as models_command
from memtrack.cli import train as command
from memtrack.engines import TorchEngine
from memtrack.errors import EngineUnavailableError, ModelNotFoundError
from memtrack.film import ArrayFilm
from memtrack.models import load_model
from memtrack.motion import MOTION
from memtrack.refinement import EDGE_PX
from memtrack.retinanet import OUTPUTS
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import simulate
from memtrack.tracks_io import write_tracks
from memtrack.training.config import read_config
from memtrack.training.optimise import crowds_model, new_net


def arguments(module: object, *words: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    module.add_arguments(parser)  # type: ignore[attr-defined]
    return parser.parse_args(words)


@pytest.mark.parametrize("missing", ["torch", "nncf"])
def test_what_training_needs_is_asked_for_before_the_recipe_is_read(
    missing: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "nncf", None if missing == "nncf" else sys)
    if missing == "torch":
        monkeypatch.setitem(sys.modules, "torch", None)
    with pytest.raises(EngineUnavailableError, match=rf'{missing} cannot be loaded .* pip install "memtrack\[train\]"'):
        command.run(arguments(command, str(tmp_path / "missing.toml")))


@pytest.mark.filterwarnings("ignore")  # of torch's tracing and of nncf, which are not ours to mend
def test_a_training_from_annotated_films_registers_a_model_to_start_from(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("nncf")
    monkeypatch.setenv("MEMTRACK_MODELS", str(tmp_path / "models"))
    for k, name in enumerate(("one", "two")):
        recipe = draw_recipe("collagen", np.random.default_rng(k + 3), width=96, height=96, frames=24)
        made = simulate(recipe, k)
        tifffile.imwrite(tmp_path / f"{name}.tif", ArrayFilm(made.film.frames).frames)
        write_tracks(tmp_path / f"{name}.csv", made.truth)
    text = """
[model]
name = "mine"
widths = [4, 4, 6, 6]
depths = [1, 1, 1]
[[training]]
family = "water"
count = 2
seed = 1
size = 96
frames = 3
[[annotated]]
film = "one.tif"
tracks = "one.csv"
frames = 4
pixel_size_um = 0.25
frame_interval_seconds = 0.0167
[[annotated]]
film = "two.tif"
tracks = "two.csv"
role = "validation"
frames = 4
pixel_size_um = 0.25
frame_interval_seconds = 0.0167
[optimisation]
iterations = 6
batch = 2
crop = 64
warm_up = 2
average = 0.5
checkpoint_every = 4
[refinement]
iterations = 2
batch = 4
widths = [4, 4, 6]
"""
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    assert command.run(arguments(command, str(path))) == 0
    model = load_model("mine")
    assert model.card.training["config"]["annotated"][1]["role"] == "validation"
    features = np.full((len(MOTION.channels), 32, 48), NEUTRAL, np.uint8)
    assert not (tmp_path / "mine.work" / "checkpoint.pt").exists()
    assert model.engine("openvino").run(features).shape == (OUTPUTS, 8, 12)
    assert (tmp_path / "mine.work" / "loss.svg").read_text(encoding="utf-8").startswith("<svg")
    # A model of the registry can be the start of another, if features and net are the same.
    tuned = replace(read_config(path).model, name="tuned", start_from="mine 1")
    weights = new_net(tuned).state_dict()["predict.weight"]
    trained = model.engine("torch")
    assert isinstance(trained, TorchEngine)
    torch.testing.assert_close(weights, trained.net.state_dict()["predict.weight"])
    with pytest.raises(ModelNotFoundError, match="has other features or another net"):
        new_net(replace(tuned, widths=(8, 8, 8, 8)))
    # And take over in crowds, if features and cells are the same.
    assert crowds_model(tuned) == ""
    assert crowds_model(replace(tuned, crowds="mine")) == "mine 1"
    with pytest.raises(ModelNotFoundError, match="model mine 1 has other features or cells of another length"):
        crowds_model(replace(tuned, crowds="mine 1", cell_length_px=(5.0, 9.0)))
    capsys.readouterr()
    assert models_command.run(arguments(models_command)) == 0
    assert "mine 1" in capsys.readouterr().out


@pytest.mark.filterwarnings("ignore")  # as above
def test_a_training_can_keep_the_net_and_learn_its_centres_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("nncf")
    monkeypatch.setenv("MEMTRACK_MODELS", str(tmp_path / "models"))
    text = """
[model]
name = "centred"
widths = [16, 32, 48, 64]
depths = [1, 2, 1]
start_from = "default 7"
[[training]]
family = "water"
count = 2
seed = 1
size = 128
frames = 3
[[validation]]
family = "water"
count = 1
seed = 5
size = 128
frames = 3
[optimisation]
iterations = 0
[refinement]
iterations = 3
batch = 4
widths = [4, 4, 6]
"""
    path = tmp_path / "centred.toml"
    path.write_text(text, encoding="utf-8")
    unlink = os.unlink

    def held(file: str | Path, **options: Any) -> None:
        if Path(file).name == "centres.bin":
            raise PermissionError(errno.EACCES, "mapped, as Windows has it")
        unlink(file, **options)

    with monkeypatch.context() as windows:
        windows.setattr(os, "unlink", held)
        windows.setattr(tempfile, "tempdir", str(tmp_path))
        assert command.run(arguments(command, str(path))) == 0
    # The one validation film is a thing too small for it to find anything in.
    assert "nothing that the model finds in the validation films is right" in capsys.readouterr().err
    kept, made = load_model("default", "7").card, load_model("centred").card
    assert {name: made.files[name] for name in kept.files} == kept.files
    assert (made.thresholds, made.decoder) == (kept.thresholds, kept.decoder)
    crops = np.full((2, len(MOTION.channels), EDGE_PX, EDGE_PX), NEUTRAL, np.uint8)
    refiner = load_model("centred").refiner()
    assert refiner is not None
    first = refiner.estimates(crops)
    assert np.isfinite(first).all()
    # The next one goes on from there.
    again = text.replace("centred", "again").replace("default 7", "centred").replace("iterations = 3", "iterations = 1")
    path.write_text(again + "learning_rate = 1e-9\n", encoding="utf-8")
    assert command.run(arguments(command, str(path))) == 0
    refiner = load_model("again").refiner()
    assert refiner is not None
    np.testing.assert_allclose(refiner.estimates(crops), first, atol=0.01)
