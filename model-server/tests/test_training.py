# SPDX-License-Identifier: GPL-3.0-or-later
import argparse
import ast
import json
import subprocess
import sys
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
import tifffile

import memtrack
from memtrack.channels import NEUTRAL
from memtrack.cli import models as models_command
from memtrack.cli import train as command
from memtrack.engines import TorchEngine
from memtrack.errors import EngineUnavailableError, ModelNotFoundError, SettingsError
from memtrack.film import ArrayFilm, Calibration
from memtrack.models import load_model
from memtrack.motion import MOTION, FeatureSpec
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import simulate
from memtrack.tracks import Motility, TrackTable
from memtrack.tracks_io import write_tracks
from memtrack.training.config import ModelSettings, Optimisation, TrainingConfig, read_config
from memtrack.training.films import _SHAPING, SimulatedSet, simulated_samples, with_motility
from memtrack.training.samples import FilmSamples, extract

torch = pytest.importorskip("torch")

from memtrack.retinanet import OUTPUTS, build  # noqa: E402
from memtrack.training.batches import Batches  # noqa: E402
from memtrack.training.loss import LossSettings, detection_loss, targets  # noqa: E402
from memtrack.training.recipe import train  # noqa: E402
from memtrack.training.train import Workspace, new_net, optimise  # noqa: E402

RECIPES = Path(__file__).parents[1] / "recipes"


def test_targets_of_one_bacterium() -> None:
    out = targets(np.array([[17.5, 9.5, 2, 0]], np.float32), 32, 48, 4, LossSettings(positive_px=3, ring_px=6))
    presence, weight, level, dx, dy = out
    assert out.shape == (5, 8, 12)
    rows, columns = np.nonzero(presence)
    assert set(zip(rows.tolist(), columns.tolist(), strict=True)) == {(2, 4)}  # its centre is (17.5, 9.5)
    assert (level[2, 4], dx[2, 4], dy[2, 4]) == (2, 0, 0)
    assert weight[2, 4] == 1
    assert weight[2, 5] == weight[1, 4] == weight[3, 5] == 0  # 4 and 5.7 px away: unsure
    assert weight[2, 6] == 1
    assert presence[2, 6] == 0


def test_each_place_points_to_its_nearest_bacterium_and_both_neighbours_answer() -> None:
    truth = np.array([[20, 20, 0, 0], [27, 20, 1, 0]], np.float32)
    presence, _, level, dx, _ = targets(truth, 48, 48, 4, LossSettings())
    columns = np.nonzero(presence[4:6].any(axis=0))[0]
    centres = {round(float(1.5 + 4 * c + 4 * dx[r, c]), 3) for r in range(12) for c in columns if presence[r, c]}
    assert centres == {20.0, 27.0}
    assert {int(level[r, c]) for r in range(12) for c in columns if presence[r, c]} == {0, 1}


def test_an_ignored_bacterium_is_neither_present_nor_absent() -> None:
    presence, weight, *_ = targets(np.array([[20, 20, 0, 1]], np.float32), 48, 48, 4, LossSettings())
    assert not presence.any()
    assert weight[4, 4] == 0
    assert weight[11, 11] == 1


def test_nothing_to_find_means_silence_everywhere() -> None:
    presence, weight, *_ = targets(np.zeros((0, 4), np.float32), 32, 32, 4, LossSettings())
    assert not presence.any()
    assert weight.all()


def test_the_loss_falls_when_the_maps_come_nearer() -> None:
    wanted = torch.from_numpy(targets(np.array([[17, 9, 1, 0]], np.float32), 32, 32, 4, LossSettings())[None])
    silent = torch.zeros(1, OUTPUTS, 8, 8)
    silent[:, 0] = -4.0
    right = silent.clone()
    right[:, 0] = torch.where(wanted[:, 0] > 0, 4.0, -4.0)
    right[:, 2] = 3.0
    right[:, 4:] = wanted[:, 3:]
    loud = silent.clone()
    loud[:, 0] = 4.0
    values = [float(detection_loss(maps, wanted, LossSettings())[0]) for maps in (right, silent, loud)]
    assert values == sorted(values)
    assert values[0] < 0.02


@pytest.mark.parametrize("architecture", [{"name": "compact", "widths": (4, 6, 8, 10), "depths": (1, 1, 1)}])
def test_the_compact_net_has_a_map_every_four_pixels(architecture: dict[str, object]) -> None:
    net = build(architecture, 3).eval()
    with torch.inference_mode():
        assert net(torch.zeros(2, 3, 48, 80, dtype=torch.uint8)).shape == (2, OUTPUTS, 12, 20)


def test_the_papers_kind_of_net_runs() -> None:
    pytest.importorskip("torchvision")
    net = build({"name": "resnet50_fpn"}, 3).eval()
    with torch.inference_mode():
        assert net(torch.zeros(1, 3, 64, 96, dtype=torch.uint8)).shape == (1, OUTPUTS, 16, 24)


def test_an_unknown_net_is_refused() -> None:
    with pytest.raises(SettingsError, match="architecture 'yolo' is unknown"):
        build({"name": "yolo"}, 3)


def samples(rows: list[list[float]]) -> FilmSamples:
    features = np.full((1, 2, 64, 64), NEUTRAL, np.uint8)
    for x, y, *_ in rows:
        features[0, 0, int(y), int(x)] = 255
    return FilmSamples(features, (np.array(rows, np.float32).reshape(-1, 4),))


def test_flips_and_transposes_move_pixels_and_truth_alike() -> None:
    film = samples([[20, 37, 0, 0]])
    spec = FeatureSpec("t", 1, ("flow", "spread"))
    batches = Batches([film], spec, crop=48, size=32, stride=4, loss=LossSettings())
    features, wanted, chosen = batches.draw(np.random.default_rng(0))
    assert not chosen.any()
    seen = 0
    for crop, target in zip(features, wanted, strict=True):
        spots = np.argwhere(crop[0] == 255)
        places = np.argwhere(target[0] > 0)
        assert len(spots) <= 1
        if len(spots) and len(places):
            r, c = places[0]
            centre = (1.5 + 4 * (c + target[3, r, c]), 1.5 + 4 * (r + target[4, r, c]))
            np.testing.assert_allclose(centre, spots[0][::-1], atol=1e-3)
            seen += 1
    assert seen > 10


def test_films_the_net_fails_on_are_drawn_more_often() -> None:
    films = [samples([[10, 10, 0, 0]]) for _ in range(4)]
    batches = Batches(films, FeatureSpec("t", 1, ("flow", "spread")), crop=48, size=16, stride=4, loss=LossSettings())
    for _ in range(20):
        batches.learned(np.arange(4), np.array([0.1, 0.1, 0.1, 5.0], np.float32))
    drawn = np.concatenate([batches.draw(np.random.default_rng(k))[2] for k in range(20)])
    assert (drawn == 3).mean() > 0.5


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


def test_the_shipped_recipe_can_be_read_and_is_the_shipped_models() -> None:
    config = read_config(RECIPES / "default.toml")
    assert not {s.family for s in config.training} & {"foam", "granular"}
    seeds = {(s.family, s.seed + k) for s in config.training for k in range(s.count)}
    assert seeds.isdisjoint((s.family, s.seed + k) for s in config.validation for k in range(s.count))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[model]\nname = 'a'\nspeed = 3", r"\[model\]: unknown key 'speed'"),
        ("[model]\nname = 3", r"\[model\]: name is 3, expected str"),
        ("[modell]\nname = 'a'", r"unknown part \['modell'\]"),
        ("[optimisation]\nbatch = 2", r"the part \[model\] is missing"),
        ("[model]\nname = 'a'\nfeatures = 'x'", r"\[model\]: features is 'x', use one of motion"),
        ("[model]\nname = 'Mein Modell'", r"\[model\]: 'Mein Modell' is no model name or version: use 1 to 64 of a-z"),
        ("[model]\nname = 'a'\narchitecture = 'yolo'", "architecture is 'yolo', use one of compact, resnet50_fpn"),
        ("[model]\nname = 'a'\nwidths = [16, 32]", r"widths is \[16, 32\], expected tuple\[int, int, int, int\]"),
        ("[model]\nname = 'a'\nwidths = [16, 32, 48, '64']", r"widths is \[16, 32, 48, '64'\], expected tuple"),
        ("[model]\nname = 'a'\nwidths = [16, 32, 48, 0]", r"widths is \[16, 32, 48, 0\], use 1 to 4096"),
        ("[model]\nname = 'a'\ncell_length_px = [12.0, 4]", "cell_length_px is 12 to 4, give the smaller length first"),
        ("[model]\nname = 'a'\nbox_size_px = nan", "box_size_px is nan, use 1 to 1000"),
        ("[model]\nname = 'a'\n[optimisation]\ncrop = 100", r"\[optimisation\]: crop is 100, use a multiple of 16"),
        ("[model]\nname = 'a'\n[optimisation]\niterations = 0", r"\[optimisation\]: iterations is 0, use 1 to 1e\+08"),
        ("[model]\nname = 'a'\n[optimisation]\nlearning_rate = -1", "learning_rate is -1, use 1e-09 to 10"),
        ("[model]\nname = 'a'\n[loss]\nalpha = 2", r"\[loss\]: alpha is 2, use 0 to 1"),
        (
            "[model]\nname = 'a'\n[[training]]\nfamily = 'milk'\ncount = 1\nseed = 1",
            r"\[\[training\]\]: family is 'milk', use one of collagen, water",
        ),
        (
            "[model]\nname = 'a'\n[[annotated]]\nfilm = 'a.tif'\ntracks = 'a.csv'\nrole = 'test'",
            r"\[\[annotated\]\]: role is 'test', use one of training, validation",
        ),
        ("[model]\nname = 'a'", "at least one film for training and one for validation"),
        ("[model]\nname = 'a'\n[[training]]\ncount = 2", r"\[\[training\]\]"),
        ("name = ", "cannot be read"),
    ],
)
def test_a_recipe_that_is_not_one_is_refused(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "r.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SettingsError, match=message):
        read_config(path)


def test_every_default_of_a_recipe_is_in_its_range(tmp_path: Path) -> None:
    path = tmp_path / "r.toml"
    for kind, part in ((ModelSettings("a"), "model"), (LossSettings(), "loss"), (Optimisation(), "optimisation")):
        pairs = [f"{k} = {json.dumps(v)}" for k, v in asdict(kind).items()]
        model = "" if part == "model" else "[model]\nname = 'a'\n"
        path.write_text(f"{model}[{part}]\n" + "\n".join(pairs), encoding="utf-8")
        with pytest.raises(SettingsError, match="a training needs at least one film"):
            read_config(path)


def test_a_missing_model_to_start_from_is_said_before_films_are_made(tmp_path: Path) -> None:
    config, _ = small_training()
    config = replace(config, model=replace(config.model, start_from="nobody"))
    workspace = Workspace(tmp_path)
    with pytest.raises(ModelNotFoundError, match="there is no model nobody"):
        train(config, workspace, tmp_path, base=tmp_path, device="cpu", workers=1, report=silent)
    assert not workspace.samples.exists()


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
    capsys.readouterr()
    assert models_command.run(arguments(models_command)) == 0
    assert "mine 1" in capsys.readouterr().out


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


def test_an_interrupted_training_goes_on_to_the_same_weights(tmp_path: Path) -> None:
    config, films = small_training()
    workspace = Workspace(tmp_path)
    whole = optimise(config, films, workspace, "cpu", silent).state_dict()
    assert workspace.checkpoint.is_file()
    resumed = optimise(config, films, workspace, "cpu", silent).state_dict()
    assert set(whole) == set(resumed)
    for name, value in whole.items():
        torch.testing.assert_close(value, resumed[name])


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
