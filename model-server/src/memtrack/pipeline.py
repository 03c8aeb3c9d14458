# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole method, film in, pruned detections out, frame by frame (paper section "Methods", parts 1 to 3)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float64

from memtrack.background import split_drift
from memtrack.bands import without_bands
from memtrack.blanks import FilledFilm, without_blanks
from memtrack.defects import without_defects
from memtrack.detections import Detections, FrameDetections
from memtrack.errors import SettingsError
from memtrack.film import Film
from memtrack.first_look import crowd_in, fitting, free_resting
from memtrack.lookahead import ahead
from memtrack.models import Model
from memtrack.nets import Nets
from memtrack.progress import Report, Stage
from memtrack.pruning import faint, prune
from memtrack.resampling import scaled
from memtrack.scale import model_scale, shows_larger
from memtrack.settings import DetectionSettings
from memtrack.stabilisation import measure_motion
from memtrack.view import View

BLANK_MARGIN_PX = 6.0
"""Where the scene drifts, the edge of a blank part seems to move, and passes for cells so near to it at most, at the
model's scale."""


def detect_film(
    film: Film,
    model: Model,
    settings: DetectionSettings,
    report: Report,
    warn: Callable[[str], None] = lambda sentence: None,
    taken: Callable[[Model], None] = lambda model: None,
) -> Iterator[FrameDetections]:
    """Detects the bacteria of each frame, in the order of the frames, none dropped.

    Reads the film up to four times through `film.frame`, some of its frames several times more; holds a few.
    `report(stage, done, total)` is called at least once a frame in every stage and may raise `CancelledError`. The
    backgrounds of a long film after the first are made while detecting, each when its frames come. `warn(sentence)` is
    called with what the user should know about the film, `taken(model)` with the model for crowds where it takes over,
    before the first frame.

    Raises:
        FilmError: the film holds values that are not finite.
        SettingsError: the region has another size than the film, or its pixel size is impossible.
        EngineUnavailableError: the model's computing library is not installed.
    """
    _check(film, settings)
    film = mended(film)
    done, count = 0, film.frame_count

    def alive() -> None:
        report(Stage.DETECTING, done, count)

    nets = Nets.of(model, settings)
    view = _view(film, model, settings, report, alive, warn)
    if settings.cell_length_px is None:
        view = _fitting(view, nets, settings, alive, warn)
    if settings.resting:
        warn(free_resting(view, nets, settings.pruner(model.card), alive))
        view = view.renewed()
    listing = _Listing.of(view, settings)
    if model.crowds is not None:
        for_crowds = Nets.of(model.crowds, settings)
        crowd = _crowd(listing, nets, for_crowds)
        if crowd:
            warn(crowd)
            taken(model.crowds)
            nets = for_crowds
    frames = (view.features.channels(i) for i in range(count))
    with ahead(nets.candidates, frames, settings.threads) as candidates_of_frames:
        for i, on_grid in enumerate(candidates_of_frames):
            done = i + 1
            report(Stage.DETECTING, done, count)
            yield listing.of_frame(i, on_grid, nets.model)


def _view(
    film: Film,
    model: Model,
    settings: DetectionSettings,
    report: Report,
    alive: Callable[[], None],
    warn: Callable[[str], None],
) -> View:
    """The film at the model's scale, stabilised, with its first background."""
    scale, threads = model_scale(film, model, settings), settings.threads
    stabilising, background = _at(report, Stage.STABILISING), _at(report, Stage.BACKGROUND)
    motion = measure_motion(scaled(film, scale), stabilise=settings.stabilise, report=stabilising, threads=threads)
    if motion.unmeasured:
        warn(motion.unmeasured)
    if motion.unlit:
        count = film.frame_count
        warn(
            f"{len(motion.unlit)} of {count} frames are far darker or brighter than the others and are not used; the "
            f"first is number {min(motion.unlit) + 1} of the {count}."
        )
    return View.of(film, scale, motion, model.card.features, report=background, alive=alive, threads=threads)


def _fitting(
    view: View, nets: Nets, settings: DetectionSettings, alive: Callable[[], None], warn: Callable[[str], None]
) -> View:
    """`view`, or a smaller one for cells that are longer than expected."""
    fitted = fitting(view, nets, settings.pruner(nets.model.card), alive, settings.threads)
    if fitted is not view:
        warn(
            f"The cells of the film seem to be about {view.scale / fitted.scale:.0f} times as long as expected, since "
            f"more are found at {fitted.scale / view.scale:g} of the usual scale, now used; give a cell length to "
            "choose."
        )
    return fitted


@dataclass(frozen=True, slots=True)
class _Listing:
    """What is listed of the candidates that a model finds in the frames of a `view`; `region`: where they count."""

    view: View
    settings: DetectionSettings
    region: Bool[np.ndarray, "h w"] | None

    @classmethod
    def of(cls, view: View, settings: DetectionSettings) -> _Listing:
        region = settings.region
        if isinstance(view.film, FilledFilm):
            margin = min(float(np.abs(view.motion.drift).max()), BLANK_MARGIN_PX)
            region = _lit(view.film, region, margin / view.scale)
        return cls(view, settings, region)

    def of_frame(self, index: int, on_grid: Detections, model: Model) -> FrameDetections:
        """Of the candidates `on_grid` of frame `index`, aligned and scaled, those listed, in the film's coordinates."""
        drift, factors = self.view.motion.drift[index], self.view.factors
        if index in self.view.motion.unlit:
            on_grid = Detections.empty()  # what frames beside it show is not in it
        pruner = self.settings.pruner(model.card, self.view.scale)
        candidates = to_film(on_grid, split_drift(drift)[1], factors)
        kept, counts = prune(candidates, pruner, self.region)
        drift_x, drift_y = drift / factors
        weak = faint(candidates, kept, pruner, self.region)
        return FrameDetections(index, kept, counts, float(drift_x), float(drift_y), weak)


def _crowd(listing: _Listing, nets: Nets, for_crowds: Nets) -> str:
    """What the user should know where the film is a crowd, told by its middle frame; empty where it is none."""
    view, region, card = listing.view, listing.region, nets.model.card
    middle = view.scene.middle
    seen = view.features.channels(middle)

    def found(by: Nets) -> FrameDetections:
        return listing.of_frame(middle, by.candidates(seen), by.model)

    area = (view.film.height * view.film.width if region is None else int(region.sum())) * view.scale**2
    crowd = crowd_in(found(nets), lambda: found(for_crowds), area)
    if not crowd:
        return ""
    return (
        f"In frame {middle + 1} of {view.film.frame_count} there are {crowd} bacteria, one for every "
        f"{area / crowd:.0f} square pixels: model {card.crowds}, which is for crowds, takes over from {card.name} "
        f"{card.version}."
    )


def mended(film: Film) -> Film:
    """`film` as every later step sees it: defective pixels replaced, rolling bands taken out and blank parts filled.

    A user's films are mended in training, too; simulated ones, captions and all, are learnt from as they are. The same
    object where there is nothing to mend. Reads up to 36 frames twice.
    """
    return without_blanks(without_bands(without_defects(film)))


def _lit(film: FilledFilm, wanted: Bool[np.ndarray, "h w"] | None, margin_px: float) -> Bool[np.ndarray, "h w"]:
    """Where detections count."""
    lit = film.lit(margin_px)
    return lit if wanted is None else lit & wanted


def caveats(film: Film, model: Model, settings: DetectionSettings) -> list[str]:
    """What the user should know before `film` is worked on, one sentence each.

    Raises:
        SettingsError: see `model_scale`.
    """
    said, scale, pixel = [], model_scale(film, model, settings), film.calibration.pixel_size_um
    if settings.cell_length_px is None:
        if pixel is None:
            said.append(
                "The film has no pixel size and no cell length was given, so it is used at its own scale, or at a "
                "smaller one where more cells are found then; give one of them to be sure."
            )
        elif shows_larger(model.card.cell_length_px, film.calibration):
            said.append(
                f"With pixels of {pixel:g} um, cells of 2 um could hardly be seen, so the film is used at its own "
                "scale, or at a smaller one where more is found then; give the length of what it shows."
            )
        elif scale < 0.25:
            said.append(f"Frames are scaled by {scale:.3g} to reach the model's scale; check the pixel size.")
    if film.frame_count < 10:
        said.append(
            f"The film has {film.frame_count} frame(s); with fewer than 10 the still background cannot be told from "
            "slow bacteria."
        )
    return said


def to_film(found: Detections, rest: tuple[float, float], factors: Float64[np.ndarray, " 2"]) -> Detections:
    """Detections on an aligned, scaled frame in the coordinates of the film's own frame.

    Args:
        found: boxes in pixels of the aligned frame at the model's scale.
        rest: what is left of that frame's drift (x, y) after the shift by whole pixels, likewise.
        factors: by which the film's frames were scaled, (x, y).
    """
    at_model_scale = found.boxes + np.array([*rest, *rest], np.float32)
    boxes = (at_model_scale + 0.5) / np.tile(factors, 2).astype(np.float32) - 0.5
    errors = None if found.errors is None else found.errors / np.float32(factors.mean())
    return replace(found, boxes=boxes.astype(np.float32), errors=errors)


def _at(report: Report, stage: Stage) -> Callable[[int, int], None]:
    return lambda done, total: report(stage, done, total)


def _check(film: Film, settings: DetectionSettings) -> None:
    region = settings.region
    if region is not None and region.shape != (film.height, film.width):
        raise SettingsError(
            f"the region has {region.shape[1]} x {region.shape[0]} pixels, the film {film.width} x {film.height}: "
            "give one of the film's size"
        )
