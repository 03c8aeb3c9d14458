# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole method, film in, pruned detections out, frame by frame (paper section "Methods", parts 1 to 3)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float64

from memtrack.background import split_drift
from memtrack.blanks import FilledFilm, without_blanks
from memtrack.channels import Channel
from memtrack.contrast import with_contrasts
from memtrack.defects import without_defects
from memtrack.detections import Detections, FrameDetections, Level
from memtrack.detector import Engine, padded
from memtrack.errors import SettingsError
from memtrack.film import Calibration, Film
from memtrack.lookahead import ahead
from memtrack.models import CRITERIA, ENGINES, Model, ModelCard
from memtrack.motion import FilmFeatures
from memtrack.progress import Report, Stage
from memtrack.pruning import PrunerSettings, faint, prune
from memtrack.refinement import Refiner, refined
from memtrack.resampling import ScaledFilm, factors_of
from memtrack.resting import SIGHTS, Looks
from memtrack.scene import Scene
from memtrack.stabilisation import measure_motion

DEVIATION = "deviation"
"""Channel of the features that tells contrasts."""
CELL_LENGTH_UM = 2.0
"""Length of the bacteria the models are trained on (paper: rods of about 2 x 0.8 um)."""
BLANK_MARGIN_PX = 6.0
"""Where the scene drifts, the edge of a blank part seems to move, and passes for cells so near to it at most, at the
model's scale."""
SUSPECTED_ROOM_PX2, CROWDED_ROOM_PX2, CROWD = 8000.0, 3500.0, 20
"""A film is a crowd, and the model's model for crowds takes over, where that one finds `CROWD` bacteria in a frame or
more, with less than `CROWDED_ROOM_PX2` square pixels for each, at the model's scale. It is asked only where the model
itself has less than `SUSPECTED_ROOM_PX2` for each box, faint ones among them: of some crowds it finds hardly more."""
SCALES = (0.05, 8.0)
"""Least and greatest factor frames are scaled by: what is more is a mistake, and would not fit into memory."""


@dataclass(frozen=True, slots=True)
class DetectionSettings:
    """How one film is to be processed.

    model, version: of the registry; version None is the newest.
    criterion: which of the model's thresholds to use, 'max_f1' as in the plug-in, or 'max_precision' as in the paper.
    thresholds: lowest score a level (low, medium, high), each 0 to 1; overrides the criterion.
    max_size_px: wider or higher boxes are dropped; 35 in the paper, counted at the model's scale, where boxes are 30.
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

    def pruner(self, card: ModelCard) -> PrunerSettings:
        """What is dropped of a model's candidates at its scale: by the thresholds given, or the criterion's."""
        return PrunerSettings(self.thresholds or card.thresholds[self.criterion], self.max_size_px, self.nms_iou)


def detect_film(
    film: Film,
    model: Model,
    settings: DetectionSettings,
    report: Report,
    warn: Callable[[str], None] = lambda sentence: None,
    taken: Callable[[Model], None] = lambda model: None,
) -> Iterator[FrameDetections]:
    """Detects the bacteria of each frame, in the order of the frames, none dropped.

    Reads the film up to four times through `film.frame`, some of its frames four times more, and holds a few of them.
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
    scale = model_scale(film, model, settings)
    scaled = film if scale == 1 else ScaledFilm(film, scale)
    factors = factors_of(film, scaled)
    region, threads = settings.region, settings.threads
    net = _Net.of(model, settings, scale)
    for_crowds = None if model.crowds is None else _Net.of(model.crowds, settings, scale)

    stabilising = _at(report, Stage.STABILISING)
    motion = measure_motion(scaled, stabilise=settings.stabilise, report=stabilising, threads=threads)
    if isinstance(film, FilledFilm):
        margin = min(float(np.abs(motion.drift).max()), BLANK_MARGIN_PX)
        region = _lit(film, region, margin / scale)
    done, count = 0, film.frame_count
    if motion.unlit:
        warn(
            f"{len(motion.unlit)} of {count} frames are far darker or brighter than the others and are not used; the "
            f"first is number {min(motion.unlit) + 1}."
        )

    def alive() -> None:
        report(Stage.DETECTING, done, count)

    scene = Scene(scaled, motion, report=_at(report, Stage.BACKGROUND), alive=alive, threads=threads)
    features = FilmFeatures(scene, model.card.features)

    def found(by: _Net, i: int, on_grid: Detections) -> FrameDetections:
        candidates = to_film(on_grid, split_drift(motion.drift[i])[1], factors)
        kept, counts = prune(candidates, by.pruner, region)
        drift_x, drift_y = motion.drift[i] / factors
        weak = faint(candidates, kept, by.pruner, region)
        return FrameDetections(i, kept, counts, float(drift_x), float(drift_y), weak)

    if settings.resting:
        warn(_free_resting(scene, features, net, settings, alive))
        features = FilmFeatures(scene, model.card.features)  # of the new background
    if for_crowds is not None:
        seen = features.channels(scene.middle)
        area = (film.height * film.width if region is None else int(region.sum())) * scale**2
        usual = found(net, scene.middle, net.candidates(seen))
        if area < SUSPECTED_ROOM_PX2 * (len(usual.detections) + len(usual.faint)):
            crowd = len(found(for_crowds, scene.middle, for_crowds.candidates(seen)).detections)
            if crowd >= CROWD and area < CROWDED_ROOM_PX2 * crowd:
                warn(
                    f"In frame {scene.middle + 1} there are {crowd} bacteria, one for every {area / crowd:.0f} square "
                    f"pixels: model {model.card.crowds}, which is for crowds, takes over from {model.card.name} "
                    f"{model.card.version}."
                )
                taken(for_crowds.model)
                net = for_crowds
    frames = (features.channels(i) for i in range(count))
    with ahead(net.candidates, frames, threads) as candidates_of_frames:
        for i, on_grid in enumerate(candidates_of_frames):
            done = i + 1
            report(Stage.DETECTING, done, count)
            yield found(net, i, on_grid)


def _free_resting(
    scene: Scene, features: FilmFeatures, net: _Net, settings: DetectionSettings, alive: Callable[[], None]
) -> str:
    """Takes bacteria that rest out of the background, by the looks of those that move; what the user should know."""
    pruner = settings.pruner(net.model.card)  # at the model's scale, as the boxes here
    moving = []
    for i in np.unique(np.linspace(0, 2 * scene.middle, SIGHTS + 2)[1:-1].astype(int)).tolist():
        alive()
        moving.append((features.deviation(i), prune(net.candidates(features.channels(i)), pruner)[0]))
    looks = Looks.of(moving)
    if looks is None:
        return "No resting bacteria were looked for: too few move that could tell how a bacterium of this film looks."
    count = scene.free_resting(looks)
    return f"{count} spot(s) that never move are as dark or as bright as the bacteria that move, and may be found, too."


@dataclass(frozen=True, slots=True)
class _Net:
    """A model's nets, ready to run, and what is dropped of their candidates, in pixels of the film."""

    model: Model
    engine: Engine
    refiner: Refiner | None
    pruner: PrunerSettings

    @classmethod
    def of(cls, model: Model, settings: DetectionSettings, scale: float) -> _Net:
        """See `Model.engine` for what it raises."""
        kind, threads = settings.engine, settings.threads
        pruner = replace(settings.pruner(model.card), max_size_px=settings.max_size_px / scale)
        return cls(model, model.engine(kind, threads=threads), model.refiner(kind, threads=threads), pruner)

    def candidates(self, channels: list[Channel]) -> Detections:
        """Of one frame; with contrasts where the model's features hold the signed deviation."""
        decoder, names = self.model.card.decoder, self.model.card.features.channels
        (height, width), together = channels[0].shape, padded(channels)
        found = decoder.decode(self.engine.run(together), height, width)
        if self.refiner is not None:
            found = refined(found, together[:, :height, :width], self.refiner)
        return with_contrasts(found, channels[names.index(DEVIATION)]) if DEVIATION in names else found


def mended(film: Film) -> Film:
    """`film` as every later step sees it, in training too: defective pixels replaced and blank parts filled.

    The same object where there are none. Reads up to 24 frames twice.
    """
    return without_blanks(without_defects(film))


def _lit(film: FilledFilm, wanted: Bool[np.ndarray, "h w"] | None, margin_px: float) -> Bool[np.ndarray, "h w"]:
    """Where detections count."""
    lit = film.lit(margin_px)
    return lit if wanted is None else lit & wanted


def caveats(film: Film, model: Model, settings: DetectionSettings) -> list[str]:
    """What the user should know before `film` is worked on, one sentence each.

    Raises:
        SettingsError: see `model_scale`.
    """
    said, scale = [], model_scale(film, model, settings)
    if film.calibration.pixel_size_um is None and settings.cell_length_px is None:
        said.append(
            "The film has no pixel size and no cell length was given, so it is used at its own scale; give one of them "
            "if its cells are much longer or shorter than those the model knows."
        )
    if film.frame_count < 10:
        said.append(
            f"The film has {film.frame_count} frame(s); with fewer than 10 the still background cannot be told from "
            "slow bacteria."
        )
    if not 0.25 <= scale <= 4:
        said.append(f"Frames are scaled by {scale:.3g} to reach the model's scale; check the pixel size.")
    return said


def model_scale(film: Film, model: Model, settings: DetectionSettings) -> float:
    """Factor that brings the film's cells to a length the model knows; 1 where they have one already.

    Raises:
        SettingsError: it is outside `SCALES`.
    """
    known = model.card.cell_length_px
    stated = settings.cell_length_px
    if stated is None:
        return scale_to(known, film.calibration)
    return _factor(known, stated, f"a cell length of {stated:g} pixels", "the length of a cell in this film")


def scale_to(cell_length_px: tuple[float, float], calibration: Calibration) -> float:
    """Factor that brings a film of this pixel size to cells of a length in `cell_length_px`; 1 without a pixel size.

    Raises:
        SettingsError: it is outside `SCALES`.
    """
    size = calibration.pixel_size_um
    if size is None:
        return 1.0
    given = f"a pixel size of {size:g} um"
    return _factor(cell_length_px, CELL_LENGTH_UM / size, given, "the true pixel size, or the length of a cell")


def _factor(known: tuple[float, float], length: float, given: str, wanted: str) -> float:
    factor = float(np.clip(length, *known)) / length
    if not SCALES[0] <= factor <= SCALES[1]:
        raise SettingsError(
            f"{given} means scaling the frames by {factor:.3g}, but {SCALES[0]:g} to {SCALES[1]:g} is possible; "
            f"give {wanted}"
        )
    return factor


def to_film(found: Detections, rest: tuple[float, float], factors: Float64[np.ndarray, " 2"]) -> Detections:
    """Detections on an aligned, scaled frame in the coordinates of the film's own frame.

    Args:
        found: boxes in pixels of the aligned frame at the model's scale.
        rest: what is left of that frame's drift (x, y) after the shift by whole pixels, likewise.
        factors: by which the film's frames were scaled, (x, y).
    """
    at_model_scale = found.boxes + np.array([*rest, *rest], np.float32)
    boxes = (at_model_scale + 0.5) / np.tile(factors, 2).astype(np.float32) - 0.5
    return replace(found, boxes=boxes.astype(np.float32))


def _at(report: Report, stage: Stage) -> Callable[[int, int], None]:
    return lambda done, total: report(stage, done, total)


def _check(film: Film, settings: DetectionSettings) -> None:
    region = settings.region
    if region is not None and region.shape != (film.height, film.width):
        raise SettingsError(
            f"the region has {region.shape[1]} x {region.shape[0]} pixels, the film {film.width} x {film.height}: "
            "give one of the film's size"
        )
