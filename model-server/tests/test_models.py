# SPDX-License-Identifier: GPL-3.0-or-later
import json
from dataclasses import replace
from pathlib import Path

import pytest

from memtrack.detector import Decoder
from memtrack.errors import ModelCorruptError, ModelNotFoundError, SettingsError
from memtrack.models import CARD, Model, ModelCard, list_models, load_model, register
from memtrack.motion import PAPER


@pytest.fixture
def registry(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = tmp_path / "models ü 模型"
    monkeypatch.setenv("MEMTRACK_MODELS", str(root))
    return root


def card(name: str = "mine") -> ModelCard:
    return ModelCard(
        name=name,
        version="0",
        description="A model for tests.",
        licence="GPL-3.0-or-later",
        architecture={"name": "compact", "widths": [4, 4, 4, 4], "depths": [1, 1, 1]},
        features=PAPER,
        decoder=Decoder(slope=1.25, offset=-0.5),
        levels=("low", "medium", "high"),
        cell_length_px=(4.0, 11.0),
        thresholds={"max_precision": (0.7, 0.6, 0.5), "max_f1": (0.4, 0.3, 0.2)},
    )


def registered(tmp_path: Path, name: str = "mine") -> Model:
    weights = tmp_path / "w.bin"
    weights.write_bytes(b"weights")
    return register(card(name), {"weights.safetensors": weights})


def test_a_card_survives_its_json() -> None:
    assert ModelCard.from_json(card().to_json()) == card()


def test_versions_count_up_and_the_newest_is_found(registry: Path, tmp_path: Path) -> None:
    versions = [registered(tmp_path).card.version for _ in range(11)]
    assert versions == [str(k) for k in range(1, 12)]
    assert load_model("mine").card.version == "11"
    assert load_model("mine", "2").card.version == "2"
    assert sum(c.name == "mine" for c in list_models()) == 11
    assert [c.version for c in list_models() if c.name == "mine"][:2] == ["11", "10"]


def test_a_changed_file_is_refused(registry: Path, tmp_path: Path) -> None:
    model = registered(tmp_path)
    model.weights.write_bytes(b"other")
    with pytest.raises(ModelCorruptError, match=r"weights\.safetensors of model mine 1 is missing or damaged"):
        load_model("mine")


def test_a_file_outside_the_models_folder_is_refused(registry: Path, tmp_path: Path) -> None:
    model = registered(tmp_path)
    values = json.loads((model.folder / CARD).read_text(encoding="utf-8"))
    values["files"] = {"../1/weights.safetensors": values["files"]["weights.safetensors"]}
    (model.folder / CARD).write_text(json.dumps(values), encoding="utf-8")
    with pytest.raises(ModelCorruptError):
        load_model("mine")


@pytest.mark.parametrize(
    "change",
    [
        {"levels": None},
        {"extra": 1},
        {"thresholds": {"max_f1": [1]}},
        {"thresholds": []},
        {"thresholds": {"max_precision": [0.5, 0.5], "max_f1": [0.5, 0.5]}, "levels": ["low", "high"]},
        {"architecture": None},
        {"name": 5},
        {"crowds": 5},
        {"crowds": "crowded"},
        {"crowds": "crowded 1 2"},
        {"crowds": "../crowded 1"},
    ],
)
def test_a_card_that_is_not_one_is_refused(change: dict[str, object]) -> None:
    values = json.loads(card().to_json()) | change
    with pytest.raises(ModelCorruptError):
        ModelCard.from_json(json.dumps(values))


def test_a_card_that_is_not_utf_8_is_refused_and_left_out_of_the_list(registry: Path, tmp_path: Path) -> None:
    model = registered(tmp_path)
    registered(tmp_path, "other")
    (model.folder / CARD).write_bytes("Modèle".encode("latin-1"))
    with pytest.raises(
        ModelCorruptError, match=r"the model card .*model\.json cannot be read .*: install the model again"
    ):
        load_model("mine")
    names = {c.name for c in list_models()}
    assert "other" in names
    assert "mine" not in names


@pytest.mark.parametrize("name", ["", "..", "a/b", "A", "x" * 65, "../mine", "mine\\1"])
def test_names_that_could_leave_the_registry_are_refused(name: str) -> None:
    with pytest.raises(SettingsError, match="is no model name or version"):
        load_model(name)


def test_a_missing_model_is_answered_with_those_there_are(registry: Path, tmp_path: Path) -> None:
    registered(tmp_path, "alpha")
    with pytest.raises(ModelNotFoundError, match="there is no model beta; the registry has: alpha 1"):
        load_model("beta")
    with pytest.raises(ModelNotFoundError, match="there is no model alpha 7"):
        load_model("alpha", "7")


def test_a_link_out_of_the_registry_is_no_model(registry: Path, tmp_path: Path) -> None:
    outside = registered(tmp_path).folder.rename(tmp_path / "elsewhere")
    try:
        (registry / "mine" / "3").symlink_to(outside, target_is_directory=True)
    except OSError:
        pytest.skip("this system makes no symbolic links without further rights")
    with pytest.raises(ModelNotFoundError):
        load_model("mine")


def test_the_model_for_crowds_comes_with_the_one_that_names_it(registry: Path, tmp_path: Path) -> None:
    first = registered(tmp_path, "many")
    registered(tmp_path, "many")
    weights = {"weights.safetensors": first.weights}
    register(replace(card(), crowds="many 1"), weights)
    assert load_model("mine").crowds == first
    register(replace(card(), crowds="many 3"), weights)
    with pytest.raises(ModelNotFoundError, match="there is no model many 3"):
        load_model("mine")
    assert load_model("mine", "1").crowds == first


def test_a_failed_registration_leaves_nothing(registry: Path, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        register(card(), {"weights.safetensors": tmp_path / "nowhere"})
    assert list_models_of(registry) == []


def list_models_of(root: Path) -> list[Path]:
    return [p for p in root.rglob("*") if p.is_file()]


def test_the_shipped_default_is_whole_and_small() -> None:
    model = load_model("default")
    assert model.card.training["config"]["model"]["name"] == "default"
    assert sum(p.stat().st_size for p in (Path(__file__).parents[1] / "src/memtrack/models").rglob("*")) < 6_500_000
