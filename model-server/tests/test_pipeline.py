# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole method: on simulated films whose truth is known, and at the edges of what it takes."""

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from memtrack.detections import Detections, FilterCounts, FrameDetections
from memtrack.errors import CancelledError, FilmError, SettingsError
from memtrack.film import ArrayFilm, Calibration
from memtrack.models import Model, load_model
from memtrack.pipeline import detect_film
from memtrack.progress import Stage
from memtrack.resampling import ScaledFilm
from memtrack.scale import model_scale
from memtrack.settings import DetectionSettings
from memtrack.simulation.film import SimulatedFilm, simulate
from memtrack.simulation.optics import Look
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait

BRIGHT = Look(length=8, width=4, contrast=60, halo=0.15, halo_radius=10, flip=0, relief=0, relief_angle=0)
GEL = Recipe(
    width=256,
    height=224,
    frames=40,
    texture=14,
    read_noise=3,
    shot_noise=2,
    gaits=(Gait.SWIMMING,) * 6 + (Gait.HOPPING,) * 8,
    looks=tuple(replace(BRIGHT, contrast=c) for c in (60, -50, 70, 45, -60, 55, 60, -50, 70, 45, -60, 55, 50, -45)),
)


@pytest.fixture(scope="module")
def model() -> Model:
    return load_model()


@pytest.fixture(scope="module")
def gel() -> SimulatedFilm:
    return simulate(GEL, 3)


def run(film: ArrayFilm | ScaledFilm, model: Model, **settings: object) -> list[FrameDetections]:
    wanted = DetectionSettings(**settings)  # type: ignore[arg-type]
    return list(detect_film(film, model, wanted, lambda stage, done, total: None))


def judge(made: SimulatedFilm, found: list[FrameDetections], scale: float = 1.0) -> tuple[float, float, float]:
    """Precision, recall and centre error (RMS, pixels) within 8 px, ignored bacteria aside."""
    hits, truths, wrong, errors = 0, 0, 0, []
    truth = made.truth
    for frame in found:
        rows = np.flatnonzero(truth.frames == frame.frame)
        places = np.stack([truth.x[rows], truth.y[rows]], axis=1)
        real = ~truth.ignored[rows]
        centres = (frame.detections.centres + 0.5) * scale - 0.5
        distance = np.linalg.norm(places[:, None] - centres[None], axis=2) if len(rows) else np.zeros((0, len(centres)))
        taken = np.zeros(len(centres), bool)
        for k in np.flatnonzero(real):
            if len(centres) and np.where(taken, np.inf, distance[k]).min() < 8:
                j = int(np.where(taken, np.inf, distance[k]).argmin())
                taken[j] = True
                errors.append(distance[k, j])
                hits += 1
        truths += int(real.sum())
        near_ignored = (distance[~real] < 12).any(axis=0)
        wrong += int((~taken & ~near_ignored).sum())
    return hits / max(hits + wrong, 1), hits / truths, float(np.sqrt(np.mean(np.square(errors))))


def test_bacteria_in_a_gel_are_found_exactly(gel: SimulatedFilm, model: Model) -> None:
    precision, recall, error = judge(gel, run(gel.film, model))
    assert precision > 0.9
    assert recall > 0.85
    assert error < 1.2


def test_the_model_for_crowds_takes_over_in_a_crowd_and_finds_more_of_it(model: Model, gel: SimulatedFilm) -> None:
    looks = tuple(replace(BRIGHT, contrast=c) for c in (60.0, 45.0, 70.0, 52.0, 58.0) * 26)
    made = simulate(replace(GEL, texture=4, gaits=(Gait.SWIMMING,) * 130, looks=looks), 3)
    said, taken = list[str](), list[Model]()

    def found(film: ArrayFilm, of: Model) -> list[FrameDetections]:
        return list(detect_film(film, of, DetectionSettings(), lambda *_: None, said.append, taken.append))

    usual = judge(made, found(made.film, replace(model, crowds=None)))
    found(gel.film, model)
    assert not said + taken
    by_default = found(made.film, model)
    crowded = judge(made, by_default)
    assert taken == [model.crowds]
    assert len(said) == 1
    assert re.match(r"In frame 21 of 40 there are \d+ bacteria, .* \d+ square pixels: model crowded 1, ", said[0])
    assert crowded[1] > usual[1] + 0.1
    assert crowded[0] > 0.95
    for one, other in zip(by_default, found(made.film, load_model("crowded", "1")), strict=True):
        np.testing.assert_array_equal(one.detections.boxes, other.detections.boxes)


def test_drift_and_flicker_cost_little_and_boxes_stay_in_the_film_the_user_sees(model: Model) -> None:
    moving = simulate(replace(GEL, drift_per_frame=(0.12, -0.08), jitter=0.2, flicker=0.02), 3)
    found = run(moving.film, model)
    precision, recall, error = judge(moving, found)
    assert precision > 0.85
    assert recall > 0.8
    assert error < 1.3
    drift = np.array([[f.drift_x, f.drift_y] for f in found])
    assert np.abs(drift - moving.drift).max() < 0.25
    assert np.abs(moving.drift).max() > 3


def on_bacteria(made: SimulatedFilm, found: list[FrameDetections]) -> Iterator[tuple[int, Detections, float]]:
    """Row of the truth, the detection nearest to it, and how far off that is, within 4 px, ignored bacteria aside."""
    for frame in found:
        for row in np.flatnonzero((made.truth.frames == frame.frame) & ~made.truth.ignored):
            distances = np.hypot(*(frame.detections.centres - (made.truth.x[row], made.truth.y[row])).T)
            if len(distances) and distances.min() < 4:
                nearest = frame.detections.select(distances.argsort()[:1])
                yield int(row), nearest, float(distances.min())


def test_contrasts_and_errors_tell_of_the_bacterium(model: Model) -> None:
    made = simulate(replace(GEL, drift_per_frame=(0.12, -0.08)), 3)
    signs, told, off = [], [], []
    for row, nearest, distance in on_bacteria(made, run(made.film, model)):
        assert nearest.contrasts is not None
        assert nearest.errors is not None
        signs.append(np.sign(nearest.contrasts[0]) == np.sign(made.recipe.looks[made.truth.ids[row]].contrast))
        told.append(nearest.errors[0])
        off.append(distance / np.sqrt(2))
    assert len(signs) > 200
    assert np.mean(signs) > 0.95
    order = np.argsort(told)
    sure, unsure = (np.sqrt(np.mean(np.square(off)[rows])) for rows in np.array_split(order, 2))
    assert sure < 0.6 * unsure
    assert 0.5 < np.sqrt(np.mean(np.square(told))) / np.sqrt(np.mean(np.square(off))) < 2


def test_stabilisation_pays_and_can_be_turned_off(model: Model) -> None:
    moving = simulate(replace(GEL, drift_per_frame=(0.12, -0.08), jitter=0.2), 3)
    without, with_it = run(moving.film, model, stabilise=False), run(moving.film, model)
    assert not any(f.drift_x or f.drift_y for f in without)
    assert judge(moving, without)[1] < judge(moving, with_it)[1] - 0.03


def test_an_empty_film_stays_empty(model: Model) -> None:
    empty = simulate(replace(GEL, gaits=(), looks=(), drift_per_frame=(0.05, 0.05), flicker=0.02), 5)
    assert sum(len(f.detections) for f in run(empty.film, model)) <= 2


def test_every_frame_is_answered_in_order_and_counted(gel: SimulatedFilm, model: Model) -> None:
    found = run(gel.film, model)
    assert [f.frame for f in found] == list(range(40))
    assert all(f.counts.kept == len(f.detections) for f in found)
    total = sum((f.counts for f in found), FilterCounts())
    assert total.candidates > total.kept > 0
    assert len(found[0].detections) > 0


def test_sixteen_bits_and_float_find_what_eight_bits_find(gel: SimulatedFilm, model: Model) -> None:
    wide = ArrayFilm((gel.film.frames.astype(np.uint16) * 15 + 100), gel.film.calibration)
    real = ArrayFilm((gel.film.frames.astype(np.float32) / 255), gel.film.calibration)
    expected = sum(len(f.detections) for f in run(gel.film, model))
    for film in (wide, real):
        assert sum(len(f.detections) for f in run(film, model)) == pytest.approx(expected, rel=0.05)


def test_a_film_at_twice_the_scale_is_brought_to_the_models(gel: SimulatedFilm, model: Model) -> None:
    large = ScaledFilm(gel.film, 3.0)
    assert model_scale(large, model, DetectionSettings()) < 0.7
    precision, recall, error = judge(gel, run(large, model), scale=1 / 3)
    assert precision > 0.85
    assert recall > 0.75
    assert error < 1.5


@pytest.mark.parametrize("calibrated", [False, True])
def test_cells_three_times_as_long_as_expected_are_found(gel: SimulatedFilm, model: Model, calibrated: bool) -> None:
    frames = np.stack([ScaledFilm(gel.film, 3.0).frame(i).clip(0, 255).astype(np.uint8) for i in range(40)])
    large = ArrayFilm(frames, gel.film.calibration if calibrated else Calibration())
    said: list[str] = []
    found = list(detect_film(large, model, DetectionSettings(), lambda *_: None, said.append))
    precision, recall, error = judge(gel, found, scale=1 / 3)
    assert precision > 0.85
    assert recall > 0.75
    assert error < 1.5
    assert re.match(r"The cells of the film seem to be about [23] times as long as expected", said[0])
    assert judge(gel, run(large, model, cell_length_px=8), scale=1 / 3)[1] < 0.5


def test_cells_as_long_as_expected_are_seen_at_the_usual_scale(gel: SimulatedFilm, model: Model) -> None:
    said: list[str] = []
    for one, other in zip(
        detect_film(gel.film, model, DetectionSettings(), lambda *_: None, said.append),
        run(gel.film, model, cell_length_px=8),
        strict=True,
    ):
        np.testing.assert_array_equal(one.detections.boxes, other.detections.boxes)
    assert said == []


def test_a_region_keeps_what_is_in_it(gel: SimulatedFilm, model: Model) -> None:
    region = np.zeros((224, 256), bool)
    region[:, :128] = True
    found = run(gel.film, model, region=region)
    centres = np.concatenate([(f.detections.boxes[:, 0] + f.detections.boxes[:, 2]) / 2 for f in found])
    assert len(centres) > 20
    assert centres.max() < 128.5
    assert sum(f.counts.outside_region for f in found) > 20


@pytest.mark.parametrize("shape", [(1, 1, 1), (1, 40, 50), (3, 5, 300), (2, 96, 96)])
@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32])
def test_films_of_any_shape_and_type_run(shape: tuple[int, int, int], dtype: type, model: Model) -> None:
    frames: np.ndarray = np.random.default_rng(0).integers(0, 255, shape).astype(dtype)
    assert len(run(ArrayFilm(frames), model)) == shape[0]


def test_a_film_of_one_value_runs(model: Model) -> None:
    assert all(not len(f.detections) for f in run(ArrayFilm(np.full((3, 50, 50), 9, np.uint16)), model))


def test_stuck_pixels_do_not_swim_through_a_drifting_scene(model: Model) -> None:
    made = simulate(replace(GEL, drift_per_frame=(0.2, 0.1)), 3)
    frames = made.film.frames.copy()
    rng = np.random.default_rng(1)
    frames[:, rng.integers(0, 224, 40), rng.integers(0, 256, 40)] = 255
    broken = SimulatedFilm(ArrayFilm(frames, made.film.calibration), made.truth, made.drift, made.recipe)
    precision, recall, _ = judge(broken, run(broken.film, model))
    clean_precision, clean_recall, _ = judge(made, run(made.film, model))
    assert precision > clean_precision - 0.02
    assert recall > clean_recall - 0.02


def test_infinite_values_are_refused(model: Model) -> None:
    frames = np.zeros((3, 50, 50), np.float32)
    frames[1, 2, 3] = np.inf
    with pytest.raises(FilmError, match="frame 2 of the 3 used holds values that are not finite"):
        run(ArrayFilm(frames), model)


def test_progress_is_reported_for_each_frame_and_stage(gel: SimulatedFilm, model: Model) -> None:
    calls: list[tuple[Stage, int, int]] = []
    list(detect_film(gel.film, model, DetectionSettings(), lambda *call: calls.append(call)))
    for stage in (Stage.STABILISING, Stage.BACKGROUND, Stage.DETECTING):
        mine = [(done, total) for s, done, total in calls if s is stage]
        assert len(mine) >= 40
        assert mine[-1][0] == mine[-1][1]
        assert mine == sorted(mine)


def test_a_long_film_is_answered_in_order_while_its_backgrounds_are_made(model: Model) -> None:
    frames = np.random.default_rng(0).integers(0, 255, (910, 16, 16), np.uint8)
    calls: list[tuple[Stage, int, int]] = []
    settings = DetectionSettings(stabilise=False, cell_length_px=8)
    found = detect_film(ArrayFilm(frames), model, settings, lambda *call: calls.append(call))
    assert [f.frame for f in found] == list(range(910))
    detecting = [(done, total) for stage, done, total in calls if stage is Stage.DETECTING]
    assert detecting == sorted(detecting)
    assert len(detecting) == 910 + 96  # the second background is made on the way
    assert detecting[-1] == (910, 910)
    assert [stage for stage, _, _ in calls] == sorted(stage for stage, _, _ in calls)


def test_the_edge_of_a_blank_part_is_no_cell_where_the_scene_drifts_past_it(model: Model) -> None:
    drifting = simulate(replace(GEL, drift_per_frame=(0.15, 0.1)), 3)
    frames = drifting.film.frames.copy()
    y, x = np.mgrid[: GEL.height, : GEL.width]
    from_edge = 108 - np.hypot(x - GEL.width / 2, y - GEL.height / 2)
    frames[:, from_edge < 0] = 0
    wanted = from_edge > 0
    wanted[:, :100] = False  # what the user selected still counts
    found = run(ArrayFilm(frames), model, region=wanted, thresholds=(0.1, 0.1, 0.1))
    boxes = np.concatenate([frame.detections.boxes for frame in found])
    columns, rows = (np.rint((boxes[:, k] + boxes[:, k + 2]) / 2).astype(int) for k in range(2))
    assert len(boxes) > 100
    assert from_edge[rows, columns].min() > 4
    assert columns.min() >= 99


def test_frames_without_light_are_told_and_hold_nothing(gel: SimulatedFilm, model: Model) -> None:
    dark = gel.film.frames.copy()
    dark[3:5] //= 20
    said: list[str] = []
    found = list(detect_film(ArrayFilm(dark), model, DetectionSettings(), lambda *_: None, said.append))
    assert [len(frame.detections) + len(frame.faint) for frame in found[3:5]] == [0, 0]
    assert len(found[2].detections) > 0
    assert len(said) == 1
    assert said[0].startswith(f"2 of {len(dark)} frames are far darker")
    assert said[0].endswith(f"the first is number 4 of the {len(dark)}.")


@pytest.mark.parametrize(
    ("shape", "told"),
    [
        ((4, 95, 120), "At the model's scale the frames have 120 x 95 pixels; .* 96 x 96"),
        ((4, 96, 120), "share no scene"),
    ],
)
def test_a_drift_that_cannot_be_told_is_said_before_the_first_frame_where_it_is_to_be_undone(
    shape: tuple[int, int, int], told: str, model: Model
) -> None:
    noise = ArrayFilm(np.random.default_rng(0).integers(0, 255, shape, np.uint8))
    said: list[str] = []
    next(detect_film(noise, model, DetectionSettings(), lambda *_: None, said.append))
    assert len(said) == 1
    assert re.search(told, said[0])
    list(detect_film(noise, model, DetectionSettings(stabilise=False), lambda *_: None, said.append))
    assert len(said) == 1


@pytest.mark.parametrize("stage", [Stage.STABILISING, Stage.BACKGROUND, Stage.DETECTING])
def test_a_report_that_raises_stops_the_work(stage: Stage, gel: SimulatedFilm, model: Model) -> None:
    def report(at: Stage, done: int, total: int) -> None:
        if at is stage:
            raise CancelledError("the caller no longer wants the result")

    with pytest.raises(CancelledError):
        list(detect_film(gel.film, model, DetectionSettings(), report))


def test_a_region_of_another_size_is_refused(gel: SimulatedFilm, model: Model) -> None:
    with pytest.raises(SettingsError, match="the region has 10 x 20 pixels, the film 256 x 224"):
        run(gel.film, model, region=np.ones((20, 10), bool))
