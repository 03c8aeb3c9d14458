# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipe of a training, from a TOML file; an unknown key is an error."""

from __future__ import annotations

import dataclasses
import tomllib
from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from memtrack.detector import ALIGNMENT
from memtrack.errors import SettingsError
from memtrack.models import check_name
from memtrack.motion import SPECS
from memtrack.retinanet import ARCHITECTURES
from memtrack.simulation.families import FAMILIES
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
    widths: tuple[int, int, int, int] = (16, 32, 48, 64)
    depths: tuple[int, int, int] = (1, 2, 1)
    features: str = "motion"
    cell_length_px: tuple[float, float] = (4.0, 11.0)
    box_size_px: float = 30.0
    start_from: str = ""
    """'name' or 'name version' of a model of the registry whose weights are the start (fine-tuning)."""
    crowds: str = ""
    """'name' or 'name version' of a model of the registry that takes over where a film is crowded; empty for none."""

    def __post_init__(self) -> None:
        check_name(self.name)
        low, high = self.cell_length_px
        if low > high:
            raise SettingsError(f"cell_length_px is {low:g} to {high:g}, give the smaller length first")


@dataclass(frozen=True, slots=True)
class Optimisation:
    """AdamW with warm-up and a cosine fall. crop in pixels; batch in crops; checkpoint_every in iterations.

    iterations: 0 keeps the net of the model to start from as it is, thresholds and all.
    """

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
    """Compute in bfloat16 where the processor or GPU is made for it; elsewhere in 32 bits."""

    def __post_init__(self) -> None:
        if self.crop % ALIGNMENT:
            raise SettingsError(f"crop is {self.crop}, use a multiple of {ALIGNMENT}")


@dataclass(frozen=True, slots=True)
class Refinement:
    """The training of the net that refines centres, after the other and likewise; it goes on from that of the model to
    start from, if that has one of these widths. iterations: 0 for no such net. batch in crops. widths: see
    `memtrack.centre_net.CentreNet`."""

    iterations: int = 4000
    batch: int = 128
    widths: tuple[int, int, int] = (24, 32, 48)
    learning_rate: float = 1e-3
    weight_decay: float = 1e-3
    warm_up: int = 100
    clip: float = 5.0
    average: float = 0.998
    seed: int = 1
    bfloat16: bool = True


@dataclass(frozen=True, slots=True)
class TrainingConfig:
    """A whole training: model, films for learning and for choosing thresholds, loss, optimisation and refinement."""

    model: ModelSettings
    training: tuple[SimulatedSet, ...] = ()
    validation: tuple[SimulatedSet, ...] = ()
    annotated: tuple[Annotated, ...] = ()
    loss: LossSettings = field(default_factory=LossSettings)
    optimisation: Optimisation = field(default_factory=Optimisation)
    refinement: Refinement = field(default_factory=Refinement)

    def __post_init__(self) -> None:
        if not self.optimisation.iterations and not self.model.start_from:
            raise SettingsError("iterations is 0, so the net stays as it is: give a model to start_from")
        roles = {a.role for a in self.annotated}
        if not (self.training or "training" in roles) or not (self.validation or "validation" in roles):
            raise SettingsError("a training needs at least one film for training and one for validation")


def read_config(path: Path) -> TrainingConfig:
    """The recipe in `path`.

    Raises:
        SettingsError: the file cannot be read, or a part or key is unknown, missing, of the wrong type or out of range;
            the message names it.
    """
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise SettingsError(f"cannot read the training recipe {path}: {error.strerror}; check the path") from error
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise SettingsError(f"the training recipe {path} cannot be read: {error}") from error
    tables = {"training": SimulatedSet, "validation": SimulatedSet, "annotated": Annotated}
    known = {"model", "loss", "optimisation", "refinement", *tables}
    if set(values) - known:
        raise SettingsError(f"{path.name}: unknown part {sorted(set(values) - known)}: use {', '.join(sorted(known))}")
    if "model" not in values:
        raise SettingsError(f"{path.name}: the part [model] is missing")
    for name, part in values.items():
        if name in tables and not (isinstance(part, list) and all(isinstance(row, dict) for row in part)):
            raise SettingsError(f"{path.name}: {name} is no list of parts: write it as [[{name}]], in double brackets")
        if name not in tables and not isinstance(part, dict):
            raise SettingsError(f"{path.name}: {name} is no single part: write it as [{name}], in single brackets")
    rows: dict[str, Any] = {
        name: tuple(_make(kind, row, f"{path.name} [[{name}]]") for row in values.get(name, ()))
        for name, kind in tables.items()
    }
    return TrainingConfig(
        model=_make(ModelSettings, values["model"], f"{path.name} [model]"),
        loss=_make(LossSettings, values.get("loss", {}), f"{path.name} [loss]"),
        optimisation=_make(Optimisation, values.get("optimisation", {}), f"{path.name} [optimisation]"),
        refinement=_make(Refinement, values.get("refinement", {}), f"{path.name} [refinement]"),
        **rows,
    )


def _make(kind: type[T], values: dict[str, Any], where: str) -> T:
    fields = {f.name: str(f.type) for f in dataclasses.fields(kind)}  # type: ignore[arg-type]
    for key, value in values.items():
        if key not in fields:
            raise SettingsError(f"{where}: unknown key {key!r}: use {', '.join(fields)}")
        if not _fits(value, fields[key]):
            raise SettingsError(f"{where}: {key} is {value!r}, expected {fields[key]}")
        if key in _RANGES[kind]:
            low, high = _RANGES[kind][key]
            if not all(low <= number <= high for number in (value if isinstance(value, list) else [value])):
                raise SettingsError(f"{where}: {key} is {value!r}, use {low:g} to {high:g}")
        if key in _CHOICES and value not in _CHOICES[key]:
            raise SettingsError(f"{where}: {key} is {value!r}, use one of {', '.join(_CHOICES[key])}")
    try:
        return kind(**{k: tuple(v) if isinstance(v, list) else v for k, v in values.items()})
    except (TypeError, SettingsError) as error:
        raise SettingsError(f"{where}: {error}") from error


def _fits(value: object, expected: str) -> bool:
    """Whether a value of a TOML file is of the type a field is declared with."""
    if expected.startswith("tuple["):
        parts = expected.removeprefix("tuple[").removesuffix("]").split(", ")
        return isinstance(value, list) and len(value) == len(parts) and all(map(_fits, value, parts))
    return isinstance(value, _TYPES[expected]) and (expected == "bool" or not isinstance(value, bool))


_TYPES: dict[str, type | tuple[type, ...]] = {"str": str, "int": int, "float": (int, float), "bool": bool}
_CHOICES: dict[str, Collection[str]] = {
    "architecture": ARCHITECTURES,
    "features": SPECS,
    "family": FAMILIES,
    "role": ("training", "validation"),
}
_RANGES: dict[type, dict[str, tuple[float, float]]] = {
    ModelSettings: {"widths": (1, 4096), "depths": (0, 64), "cell_length_px": (1, 200), "box_size_px": (1, 1000)},
    Optimisation: {
        "iterations": (0, 1e8),
        "batch": (1, 4096),
        "crop": (16, 4096),
        "learning_rate": (1e-9, 10),
        "weight_decay": (0, 1),
        "warm_up": (0, 1e8),
        "clip": (1e-9, 1e9),
        "average": (0, 0.999999),
        "checkpoint_every": (1, 1e8),
        "seed": (0, 1e9),
    },
    Refinement: {
        "iterations": (0, 1e8),
        "batch": (2, 65536),
        "widths": (1, 4096),
        "learning_rate": (1e-9, 10),
        "weight_decay": (0, 1),
        "warm_up": (0, 1e8),
        "clip": (1e-9, 1e9),
        "average": (0, 0.999999),
        "seed": (0, 1e9),
    },
    LossSettings: {
        "positive_px": (0, 1000),
        "ring_px": (0, 1000),
        "ignored_px": (0, 1000),
        "gamma": (0, 10),
        "alpha": (0, 1),
        "level_weight": (0, 1e6),
        "centre_weight": (0, 1e6),
    },
    SimulatedSet: {"count": (1, 1e6), "seed": (0, 1e9), "size": (32, 8192), "frames": (1, 20000)},
    Annotated: {"pixel_size_um": (0, 1000), "frame_interval_seconds": (0, 1e5), "frames": (1, 1e6)},
}
"""Least and greatest value of numbers, and of each number of a list."""
