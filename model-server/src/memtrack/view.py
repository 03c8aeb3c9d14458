# SPDX-License-Identifier: GPL-3.0-or-later
"""A film as a model sees it: at a scale, with its still scene and its features."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float64

from memtrack.background import Progress
from memtrack.film import Film
from memtrack.motion import FeatureSpec, FilmFeatures
from memtrack.resampling import factors_of, scaled
from memtrack.scene import Scene
from memtrack.stabilisation import FilmMotion


@dataclass(frozen=True, slots=True)
class View:
    """A `film` at a `scale`; motion: at that scale. features: of the `scene` as it stands."""

    film: Film
    scale: float
    motion: FilmMotion
    scene: Scene
    features: FilmFeatures

    @classmethod
    def of(
        cls,
        film: Film,
        scale: float,
        motion: FilmMotion,
        spec: FeatureSpec,
        *,
        report: Progress,
        alive: Callable[[], None],
        threads: int,
    ) -> View:
        """Makes the first background; see `Scene` for `report`, `alive` and `threads`."""
        scene = Scene(scaled(film, scale), motion, report=report, alive=alive, threads=threads)
        return cls(film, scale, motion, scene, FilmFeatures(scene, spec))

    @property
    def factors(self) -> Float64[np.ndarray, " 2"]:
        """What x and y are really scaled by, see `factors_of`."""
        return factors_of(self.film, self.scene.film)

    def shrunk(self, factor: float, *, alive: Callable[[], None], threads: int) -> View:
        """The same film at `factor` of this scale; `alive` is called for each frame that is read."""
        motion = replace(self.motion, drift=self.motion.drift * factor)
        scale, spec = self.scale * factor, self.features.spec
        return View.of(self.film, scale, motion, spec, report=lambda done, total: alive(), alive=alive, threads=threads)

    def renewed(self) -> View:
        """With new features, for a scene that was changed."""
        return replace(self, features=FilmFeatures(self.scene, self.features.spec))
