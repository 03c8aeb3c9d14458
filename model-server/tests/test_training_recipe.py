# SPDX-License-Identifier: GPL-3.0-or-later
import json
from dataclasses import asdict
from pathlib import Path

import pytest

from memtrack.errors import SettingsError
from memtrack.training.config import ModelSettings, Optimisation, read_config
from memtrack.training.loss import LossSettings

RECIPES = Path(__file__).parents[1] / "recipes"


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
        ("[[model]]\nname = 'a'", r"model is no single part: write it as \[model\], in single brackets"),
        ("optimisation = 5\n[model]\nname = 'a'", r"optimisation is no single part: write it as \[optimisation\]"),
        (
            "[model]\nname = 'a'\n[training]\nfamily = 'water'\ncount = 1\nseed = 1",
            r"training is no list of parts: write it as \[\[training\]\], in double brackets",
        ),
        ("validation = ['a']\n[model]\nname = 'a'", r"validation is no list of parts: write it as \[\[validation"),
        ("[model]\nname = 'a'\nfeatures = 'x'", r"\[model\]: features is 'x', use one of motion"),
        ("[model]\nname = 'Mein Modell'", r"\[model\]: 'Mein Modell' is no model name or version: use 1 to 64 of a-z"),
        ("[model]\nname = 'a'\narchitecture = 'yolo'", "architecture is 'yolo', use one of compact, resnet50_fpn"),
        ("[model]\nname = 'a'\nwidths = [16, 32]", r"widths is \[16, 32\], expected tuple\[int, int, int, int\]"),
        ("[model]\nname = 'a'\nwidths = [16, 32, 48, '64']", r"widths is \[16, 32, 48, '64'\], expected tuple"),
        ("[model]\nname = 'a'\nwidths = [16, 32, 48, 0]", r"widths is \[16, 32, 48, 0\], use 1 to 4096"),
        ("[model]\nname = 'a'\ncell_length_px = [12.0, 4]", "cell_length_px is 12 to 4, give the smaller length first"),
        ("[model]\nname = 'a'\nbox_size_px = nan", "box_size_px is nan, use 1 to 1000"),
        ("[model]\nname = 'a'\n[optimisation]\ncrop = 100", r"\[optimisation\]: crop is 100, use a multiple of 16"),
        (
            "[model]\nname = 'a'\n[optimisation]\niterations = 0",
            "iterations is 0, so the net stays as it is: give a",
        ),
        ("[model]\nname = 'a'\n[refinement]\nbatch = 1", r"\[refinement\]: batch is 1, use 2 to 65536"),
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


def test_a_recipe_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    path = tmp_path / "r.toml"
    path.write_text((RECIPES / "default.toml").read_text(encoding="utf-8"), encoding="utf-8-sig")
    assert read_config(path) == read_config(RECIPES / "default.toml")


def test_every_default_of_a_recipe_is_in_its_range(tmp_path: Path) -> None:
    path = tmp_path / "r.toml"
    for kind, part in ((ModelSettings("a"), "model"), (LossSettings(), "loss"), (Optimisation(), "optimisation")):
        pairs = [f"{k} = {json.dumps(v)}" for k, v in asdict(kind).items()]
        model = "" if part == "model" else "[model]\nname = 'a'\n"
        path.write_text(f"{model}[{part}]\n" + "\n".join(pairs), encoding="utf-8")
        with pytest.raises(SettingsError, match="a training needs at least one film"):
            read_config(path)
