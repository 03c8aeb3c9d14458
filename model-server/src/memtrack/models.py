# SPDX-License-Identifier: GPL-3.0-or-later
"""The registry of models: folders `<name>/<version>` with a card, `model.json`, and the files it lists.

The package's own models and those of the folder in the environment variable MEMTRACK_MODELS (by default `models` in
the user's MEMTrack folder) are one registry. A model is used only if each file has the SHA-256 its card states.
"""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import json
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from memtrack.detections import Level
from memtrack.detector import Decoder, Engine
from memtrack.engines import OpenVinoEngine, OpenVinoRefiner, TorchEngine, TorchRefiner
from memtrack.errors import EngineUnavailableError, ModelCorruptError, ModelNotFoundError, SettingsError
from memtrack.motion import FeatureSpec
from memtrack.refinement import Refiner

CARD = "model.json"
WEIGHTS = "weights.safetensors"
OPENVINO = "openvino.xml"
CENTRE_WEIGHTS = "centres.safetensors"
CENTRE_OPENVINO = "centres.xml"
NAME = re.compile(r"[a-z0-9_.-]{1,64}")
CRITERIA = ("max_precision", "max_f1")
ENGINES = ("auto", "openvino", "torch")


@dataclass(frozen=True, slots=True)
class ModelCard:
    """Everything needed to use a model and to judge it; stored as `model.json`.

    cell_length_px: smallest and largest length of a cell the model knows, in pixels. thresholds: for each criterion one
    score a level. files: SHA-256 of each file beside the card. refiner: `widths` of the net that refines centres, empty
    for none. crowds: 'name version' of the model of the registry that takes over in a crowd, of the same features and
    cell length; empty for none.
    """

    name: str
    version: str
    description: str
    licence: str
    architecture: dict[str, Any]
    features: FeatureSpec
    decoder: Decoder
    levels: tuple[str, ...]
    cell_length_px: tuple[float, float]
    thresholds: dict[str, tuple[float, ...]]
    refiner: dict[str, Any] = field(default_factory=dict)
    crowds: str = ""
    training: dict[str, Any] = field(default_factory=dict)
    results: dict[str, Any] = field(default_factory=dict)
    files: dict[str, str] = field(default_factory=dict)

    def to_json(self) -> str:
        """The card as indented JSON."""
        return json.dumps(dataclasses.asdict(self), indent=2, ensure_ascii=False) + "\n"

    @staticmethod
    def from_json(text: str) -> ModelCard:
        """The card written by `to_json`.

        Raises:
            ModelCorruptError: not JSON, or a field is missing, unknown or of the wrong form.
        """
        try:
            values = json.loads(text)
            spec = values["features"]
            values["features"] = FeatureSpec(spec["name"], int(spec["version"]), tuple(spec["channels"]))
            values["decoder"] = Decoder(**values["decoder"])
            values["levels"] = tuple(values["levels"])
            low, high = values["cell_length_px"]
            values["cell_length_px"] = (float(low), float(high))
            values["thresholds"] = {k: tuple(float(t) for t in v) for k, v in values["thresholds"].items()}
            values["architecture"] = dict(values["architecture"])
            check_name(values["name"])
            check_name(values["version"])
            if values.get("crowds"):
                name, version = values["crowds"].split(" ")
                check_name(name)
                check_name(version)
            card = ModelCard(**values)
        except (ValueError, TypeError, KeyError, AttributeError, SettingsError) as error:
            raise ModelCorruptError(f"a model card cannot be read ({error}): install the model again") from error
        if any(len(t) != len(Level) for t in card.thresholds.values()) or set(card.thresholds) != set(CRITERIA):
            raise ModelCorruptError(f"the card of model {card.name} lacks thresholds: install the model again")
        return card


@dataclass(frozen=True, slots=True)
class Model:
    """A model of the registry whose files were found to match its card, with the one that takes over in a crowd."""

    card: ModelCard
    folder: Path
    crowds: Model | None = None

    @property
    def digest(self) -> str:
        """SHA-256 over the card, which holds those of the files: the same digest gives the same detections."""
        return _sha256(self.folder / CARD)

    @property
    def weights(self) -> Path:
        """The weights in safetensors."""
        return self.folder / WEIGHTS

    def engine_kind(self, kind: str = "auto") -> str:
        """The engine that `kind` of ENGINES comes to: 'auto' is OpenVINO where the model has its form, else torch.

        Raises:
            SettingsError: no such engine.
            EngineUnavailableError: the model has no form of it.
        """
        if kind not in ENGINES:
            raise SettingsError(f"engine {kind!r} is unknown: use one of {', '.join(ENGINES)}")
        has_openvino = OPENVINO in self.card.files
        if kind == "openvino" and not has_openvino:
            raise EngineUnavailableError(f"model {self.card.name} {self.card.version} has no OpenVINO form: use torch")
        return ("openvino" if has_openvino else "torch") if kind == "auto" else kind

    def engine(self, kind: str = "auto", *, threads: int = 1) -> Engine:
        """The net ready to run by the engine that `kind` comes to.

        Raises:
            SettingsError: no such engine.
            EngineUnavailableError: the model has no form of it, or its library is not installed.
        """
        if self.engine_kind(kind) == "openvino":
            return OpenVinoEngine(self.folder / OPENVINO, threads)
        return TorchEngine(self.card.architecture, len(self.card.features.channels), self.weights)

    def refiner(self, kind: str = "auto", *, threads: int = 1) -> Refiner | None:
        """The net that refines centres, by the engine that `kind` comes to; None where the model has none.

        Raises:
            SettingsError: no such engine.
            EngineUnavailableError: the model has no form of it, or its library is not installed.
        """
        kind = self.engine_kind(kind)
        if not self.card.refiner:
            return None
        if kind == "openvino":
            return OpenVinoRefiner(self.folder / CENTRE_OPENVINO, threads)
        channels = len(self.card.features.channels)
        return TorchRefiner(self.card.refiner["widths"], channels, self.folder / CENTRE_WEIGHTS)


def user_models() -> Path:
    """Where new models go: the environment variable MEMTRACK_MODELS, else `.memtrack/models` in the home folder."""
    given = os.environ.get("MEMTRACK_MODELS")
    return Path(given) if given else Path.home() / ".memtrack" / "models"


def _roots() -> tuple[Path, ...]:
    return Path(__file__).parent / "models", user_models()


def list_models() -> list[ModelCard]:
    """Cards of all models, by name, newest version first; a folder without a readable card is left out."""
    cards = []
    for root in _roots():
        for path in sorted(root.glob(f"*/*/{CARD}")):
            with contextlib.suppress(ModelCorruptError):
                cards.append(_read_card(path))
    newest_first = sorted(cards, key=lambda c: _order(c.version), reverse=True)
    return sorted(newest_first, key=lambda c: c.name)


def load_model(name: str = "default", version: str | None = None) -> Model:
    """The model of that name and version, the newest by default, with each file checked against its card; with the
    model for crowds that it names.

    Raises:
        ModelNotFoundError: there is none, or none for its crowds.
        ModelCorruptError: a file differs from what its card states.
    """
    model = _load(name, version)
    crowds = model.card.crowds
    return dataclasses.replace(model, crowds=_load(*crowds.split(" "))) if crowds else model


def _load(name: str, version: str | None = None) -> Model:
    """The model without that for its crowds."""
    check_name(name)
    if version is not None:
        check_name(version)
    folders = [f for root in _roots() for f in _versions(root, name) if version in (None, f.name)]
    if not folders:
        known = ", ".join(f"{c.name} {c.version}" for c in list_models()) or "none"
        wanted = name if version is None else f"{name} {version}"
        raise ModelNotFoundError(f"there is no model {wanted}; the registry has: {known}")
    folder = max(folders, key=lambda f: _order(f.name))
    card = _read_card(folder / CARD)
    for file, expected in card.files.items():
        path = folder / file
        if path.name != file or not path.is_file() or _sha256(path) != expected:
            raise ModelCorruptError(
                f"{file} of model {name} {folder.name} is missing or damaged: install the model again"
            )
    return Model(card, folder)


def register(card: ModelCard, files: Mapping[str, Path], root: Path | None = None) -> Model:
    """Copies `files` and the card into the registry as a new version, all or nothing.

    The card's `version` and `files` are set here: the next whole number, and each file's SHA-256.
    """
    root = user_models() if root is None else root
    check_name(card.name)
    home = root / card.name
    home.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=root, prefix=".new-") as temporary:
        new = Path(temporary) / "model"
        new.mkdir()
        for name, source in files.items():
            shutil.copyfile(source, new / name)
        sums = {name: _sha256(new / name) for name in files}
        taken = [_order(f.name)[0] for r in {root, *_roots()} for f in _versions(r, card.name)]
        version = str(max(taken, default=0) + 1)
        final = dataclasses.replace(card, version=version, files=sums)
        (new / CARD).write_text(final.to_json(), encoding="utf-8", newline="\n")
        os.rename(new, home / version)
    return Model(final, home / version)


def _read_card(path: Path) -> ModelCard:
    try:
        return ModelCard.from_json(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise ModelCorruptError(f"the model card {path} cannot be read ({error}): install the model again") from error


def _versions(root: Path, name: str) -> Iterator[Path]:
    home = root / name
    for card in home.glob(f"*/{CARD}"):
        # A link that leads out of the registry is no model of it.
        if card.resolve().is_relative_to(root.resolve()):
            yield card.parent


def check_name(name: str) -> None:
    """Raises SettingsError where `name` cannot be that of a model, or its version."""
    if not NAME.fullmatch(name) or set(name) == {"."}:
        raise SettingsError(f"{name!r} is no model name or version: use 1 to 64 of a-z, 0-9, '_', '.', '-'")


def _order(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", version)) or (0,)


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
