# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipe of a training, from a TOML file; an unknown key is an error."""

from __future__ import annotations

import dataclasses
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from memtrack.errors import SettingsError
from memtrack.motion import SPECS
from memtrack.training.films import Annotated, SimulatedSet
from memtrack.training.loss import LossSettings

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class ModelSettings:
    """What the new model is called, its net and its features (a name of `memtrack.motion.SPECS`).

    cell_length_px: smallest and largest length of a cell in the training films; films outside are rescaled.
    """

    name: str
    description: str = ""
    licence: str = "GPL-3.0-or-later"
    architecture: str = "compact"
    widths: tuple[int, ...] = (16, 32, 48, 64)
    depths: tuple[int, ...] = (1, 2, 1)
    features: str = "motion"
    cell_length_px: tuple[float, float] = (4.0, 11.0)
    box_size_px: float = 30.0
    start_from: str = ""
    """'name' or 'name version' of a model of the registry whose weights are the start (fine-tuning)."""


@dataclass(frozen=True, slots=True)
class Optimisation:
    """AdamW with warm-up and a cosine fall. crop in pixels; batch in crops; validate_every in iterations."""

    iterations: int = 4000
    batch: int = 8
    crop: int = 192
    learning_rate: float = 2e-3
    weight_decay: float = 1e-4
    warm_up: int = 200
    clip: float = 5.0
    average: float = 0.998
    """Share of the old in the running mean of the weights; the mean is what is kept."""
    checkpoint_every: int = 1000
    seed: int = 1
    bfloat16: bool = True


@dataclass(frozen=True, slots=True)
class TrainingConfig:
    """A whole training: model, films for learning and for choosing thresholds, loss and optimisation."""

    model: ModelSettings
    training: tuple[SimulatedSet, ...] = ()
    validation: tuple[SimulatedSet, ...] = ()
    annotated: tuple[Annotated, ...] = ()
    loss: LossSettings = field(default_factory=LossSettings)
    optimisation: Optimisation = field(default_factory=Optimisation)

    def __post_init__(self) -> None:
        if self.model.features not in SPECS:
            raise SettingsError(f"features {self.model.features!r} are unknown: use one of {', '.join(SPECS)}")
        roles = {a.role for a in self.annotated}
        if not roles <= {"training", "validation"}:
            raise SettingsError(f"roles {sorted(roles)} of annotated films: use 'training' or 'validation'")
        if not (self.training or "training" in roles) or not (self.validation or "validation" in roles):
            raise SettingsError("a training needs at least one film for training and one for validation")


def read_config(path: Path) -> TrainingConfig:
    """The recipe in `path`.

    Raises:
        SettingsError: the file cannot be read, or a key is unknown, missing or of the wrong type; the message names it.
    """
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise SettingsError(f"the training recipe {path} cannot be read: {error}") from error
    tables = {"training": SimulatedSet, "validation": SimulatedSet, "annotated": Annotated}
    known = {"model", "loss", "optimisation", *tables}
    if set(values) - known:
        raise SettingsError(f"{path.name}: unknown part {sorted(set(values) - known)}: use {', '.join(sorted(known))}")
    if "model" not in values:
        raise SettingsError(f"{path.name}: the part [model] is missing")
    rows: dict[str, Any] = {
        name: tuple(_make(kind, row, f"{path.name} [[{name}]]") for row in values.get(name, ()))
        for name, kind in tables.items()
    }
    return TrainingConfig(
        model=_make(ModelSettings, values["model"], f"{path.name} [model]"),
        loss=_make(LossSettings, values.get("loss", {}), f"{path.name} [loss]"),
        optimisation=_make(Optimisation, values.get("optimisation", {}), f"{path.name} [optimisation]"),
        **rows,
    )


def _make(kind: type[T], values: dict[str, Any], where: str) -> T:
    fields = {f.name: f for f in dataclasses.fields(kind)}  # type: ignore[arg-type]
    for key, value in values.items():
        if key not in fields:
            raise SettingsError(f"{where}: unknown key {key!r}: use {', '.join(fields)}")
        expected = str(fields[key].type).split("[")[0]
        if not isinstance(value, _TYPES[expected]) or (isinstance(value, bool) and expected != "bool"):
            raise SettingsError(f"{where}: {key} is {value!r}, expected {fields[key].type}")
    try:
        return kind(**{k: tuple(v) if isinstance(v, list) else v for k, v in values.items()})
    except TypeError as error:
        raise SettingsError(f"{where}: {error}") from error


_TYPES: dict[str, type | tuple[type, ...]] = {
    "str": str,
    "int": int,
    "float": (int, float),
    "bool": bool,
    "tuple": list,
}
