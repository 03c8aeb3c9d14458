# SPDX-License-Identifier: GPL-3.0-or-later
"""How one film is to be processed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool

from memtrack.detections import Level
from memtrack.errors import SettingsError
from memtrack.models import CRITERIA, ENGINES, ModelCard
from memtrack.pruning import PrunerSettings


@dataclass(frozen=True, slots=True)
class DetectionSettings:
    """How one film is to be processed.

    model, version: of the registry; version None is the newest.
    criterion: which of the model's thresholds to use, 'max_f1' as in the plug-in, or 'max_precision' as in the paper.
    thresholds: lowest score a level (low, medium, high), each 0 to 1; overrides the criterion.
    max_size_px: wider or higher boxes are dropped; 35 in the paper, counted at the model's scale, where all boxes of a
        model are of one size (30 in those shipped): above that it drops none, and nothing else is taken (see `pruner`).
    nms_iou: of boxes that overlap more only the best stays; 0.7 in the paper.
    stabilise: take stage drift out before the median.
    resting: find bacteria that rest all through the film, too, and debris that looks like them (`memtrack.resting`).
    region: where detections are wanted, of the film's height and width; None is everywhere.
    cell_length_px: length of a bacterium in pixels of this film. None: from the pixel size and 2 um, or, without a
        pixel size, such as the model knows.
    engine, threads: see `Model.engine`; as many frames are worked on at a time, and the result is the same.

    Raises:
        SettingsError: a value is unknown or out of range.
    """

    model: str = "default"
    version: str | None = None
    criterion: str = "max_f1"
    thresholds: tuple[float, float, float] | None = None
    max_size_px: float = 35.0
    nms_iou: float = 0.7
    stabilise: bool = True
    resting: bool = False
    region: Bool[np.ndarray, "height width"] | None = None
    cell_length_px: float | None = None
    engine: str = "auto"
    threads: int = 2

    def __post_init__(self) -> None:
        if self.criterion not in CRITERIA:
            raise SettingsError(f"criterion {self.criterion!r} is unknown: use {' or '.join(CRITERIA)}")
        PrunerSettings(self.thresholds or (0.0,) * len(Level), self.max_size_px, self.nms_iou)
        if self.engine not in ENGINES:
            raise SettingsError(f"engine {self.engine!r} is unknown: use one of {', '.join(ENGINES)}")
        if self.cell_length_px is not None and not 1 <= self.cell_length_px <= 200:
            raise SettingsError(f"cell_length_px is {self.cell_length_px}: give a length of 1 to 200 pixels")
        if not 1 <= self.threads <= 256:
            raise SettingsError(f"threads is {self.threads}: give a number from 1 to 256")

    def pruner(self, card: ModelCard, scale: float = 1) -> PrunerSettings:
        """What is dropped of a model's candidates: by the thresholds given, or the criterion's. `scale`: by which the
        film was scaled in whose pixels the candidates are.

        Raises:
            SettingsError: it would be all of them, as the model's boxes are not below `max_size_px`.
        """
        box = card.decoder.box_size_px
        if self.max_size_px <= box:  # equal ones would be dropped by chance, as their edges are rounded
            raise SettingsError(
                f"max_size_px is {self.max_size_px:g}, but all boxes of model {card.name} {card.version} have {box:g} "
                f"pixels and would be dropped: give more than {box:g}"
            )
        return PrunerSettings(
            self.thresholds or card.thresholds[self.criterion], self.max_size_px / scale, self.nms_iou
        )
