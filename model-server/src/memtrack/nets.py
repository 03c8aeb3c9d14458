# SPDX-License-Identifier: GPL-3.0-or-later
"""A model's nets at work: from the features of a frame to the candidates in it."""

from __future__ import annotations

from dataclasses import dataclass

from memtrack.channels import Channel
from memtrack.contrast import with_contrasts
from memtrack.detections import Detections
from memtrack.detector import Engine, padded
from memtrack.echoes import NEIGHBOURS, without_echoes
from memtrack.models import Model
from memtrack.refinement import Refiner, refined
from memtrack.settings import DetectionSettings

DEVIATION = "deviation"
"""Channel of the features that tells contrasts, and echoes from what is there."""


@dataclass(frozen=True, slots=True)
class Nets:
    """A model's nets, ready to run."""

    model: Model
    engine: Engine
    refiner: Refiner | None

    @classmethod
    def of(cls, model: Model, settings: DetectionSettings) -> Nets:
        """See `Model.engine` for what it raises."""
        kind, threads = settings.engine, settings.threads
        return cls(model, model.engine(kind, threads=threads), model.refiner(kind, threads=threads))

    def candidates(self, channels: list[Channel]) -> Detections:
        """Of one frame; where the model's features hold the signed deviation, with contrasts and without echoes."""
        decoder, names = self.model.card.decoder, self.model.card.features.channels
        (height, width), together = channels[0].shape, padded(channels)
        found = decoder.decode(self.engine.run(together), height, width)
        of = dict(zip(names, channels, strict=True))
        neighbours = [of[name] for name in NEIGHBOURS if name in of]
        if DEVIATION in of and neighbours:
            found = without_echoes(found, of[DEVIATION], neighbours)
        if self.refiner is not None:
            found = refined(found, together[:, :height, :width], self.refiner)
        return with_contrasts(found, of[DEVIATION]) if DEVIATION in of else found
