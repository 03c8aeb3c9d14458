# SPDX-License-Identifier: GPL-3.0-or-later
"""DetectFilm as a client sees it, with the shipped model."""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Iterable

import numpy as np
import pytest

from memtrack.detections import FilterCounts
from memtrack.film import ArrayFilm, Calibration
from memtrack.models import load_model
from memtrack.pipeline import detect_film
from memtrack.settings import DetectionSettings
from memtrack.simulation.film import simulate
from memtrack.simulation.optics import Look
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait
from memtrack.v1 import detection_pb2 as pb
from server.running import Answer, RunningServer, answer, check_order, noise, requests

LOW = pb.LevelThresholds(low=0.1, medium=0.1, high=0.1)


def rows(found: Iterable[pb.Detection]) -> np.ndarray:
    """Boxes, scores, levels (from 0), contrasts and errors."""
    table = [[d.x_min, d.y_min, d.x_max, d.y_max, d.score, d.level - 1, d.contrast, d.error] for d in found]
    return np.array(table).reshape(-1, 8)


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_a_film_gets_the_detections_of_the_method_itself(server: RunningServer, dtype: str) -> None:
    film = noise(12, 70, 110, dtype)
    found = server.detect(film, thresholds=LOW, pixel_size_um=0.25, frame_interval_seconds=1 / 60)

    model = load_model()
    settings = DetectionSettings(thresholds=(0.1, 0.1, 0.1))
    expected = list(detect_film(ArrayFilm(film, Calibration(0.25, 1 / 60)), model, settings, lambda *_: None))

    check_order(found, 12)
    for ours, theirs in zip(found.frame, expected, strict=True):
        for sent, made in ((ours.detections, theirs.detections), (ours.faint, theirs.faint)):
            expect = np.c_[made.boxes, made.scores, made.levels, made.contrasts, made.errors]
            np.testing.assert_array_equal(rows(sent), expect)
        assert (ours.drift_x, ours.drift_y) == (theirs.drift_x, theirs.drift_y)
    counts = sum((frame.counts for frame in expected), FilterCounts())
    summary = found.summary[0]
    for name in counts.__slots__:
        assert getattr(summary, name) == getattr(counts, name), name
    assert counts.kept == sum(len(f.detections) for f in found.frame)
    assert summary.frame_count == 12
    assert summary.film_sha256 == hashlib.sha256(film.tobytes()).hexdigest()
    assert summary.candidate_floor == model.card.decoder.floor
    assert (found.accepted[0].model_name, found.accepted[0].model_sha256) == ("default", model.digest)
    assert found.accepted[0].thresholds.low == 0.1
    assert found.accepted[0].engine.startswith("openvino 20")


def test_where_the_model_for_crowds_takes_over_the_client_is_told_before_the_first_frame(server: RunningServer) -> None:
    look = Look(length=8, width=4, contrast=60, halo=0.15, halo_radius=10, flip=0, relief=0, relief_angle=0)
    crowd = Recipe(width=256, height=224, frames=20, texture=4, gaits=(Gait.SWIMMING,) * 110, looks=(look,) * 110)
    film = simulate(crowd, 3).film
    found = server.detect(np.stack([film.frame(i) for i in range(film.frame_count)]))

    first, second = found.accepted
    model = load_model("default").crowds
    assert model is not None
    assert (first.model_name, second.model_name) == ("default", "crowded")
    assert (second.model_sha256, second.thresholds.low) == (model.digest, model.card.thresholds["max_f1"][0])
    assert found.order.index("frame") > len(found.order) - 1 - found.order[::-1].index("accepted")
    assert [f.frame for f in found.frame] == list(range(20))
    assert any("model crowded 1, which is for crowds, takes over" in said for said in found.summary[0].warnings)


def test_progress_rises_through_the_stages_to_one(server: RunningServer) -> None:
    found = server.detect(noise(30, 60, 60))
    fractions = [p.fraction for p in found.progress]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1
    stages = [p.stage for p in found.progress]
    assert stages == sorted(stages)
    assert set(stages) == {pb.STAGE_RECEIVING, pb.STAGE_STABILISING, pb.STAGE_BACKGROUND, pb.STAGE_DETECTING}
    assert all(0 <= p.frames_done <= p.frames_total == 30 for p in found.progress)
    times = {t.stage: t.seconds for t in found.summary[0].stage_times}
    assert set(times) == set(stages)
    assert all(seconds >= 0 for seconds in times.values())


@pytest.mark.parametrize("size", [1, 7, 64, 40 * 30 * 2 - 1])
def test_chunks_of_any_size_give_the_same(server: RunningServer, size: int) -> None:
    film = noise(3, 30, 40, "uint16")
    whole = server.detect(film, thresholds=LOW)
    split = answer(server.call(requests(film, size, thresholds=LOW)))
    assert split.frame == whole.frame
    assert split.summary[0].film_sha256 == whole.summary[0].film_sha256


@pytest.mark.parametrize(
    "film",
    [
        noise(1, 1, 1),
        noise(5, 1, 1),
        noise(1, 40, 90),
        noise(2, 3, 200),
        noise(20, 200, 3),
        np.zeros((8, 33, 47), "u1"),
    ],
    ids=["1x1, one frame", "1x1", "one frame", "flat", "tall", "all zero"],
)
def test_extreme_films_go_through(server: RunningServer, film: np.ndarray) -> None:
    found = server.detect(film)
    check_order(found, len(film))
    for frame in found.frame:
        assert np.isfinite(rows(frame.detections)).all()


def test_what_only_the_frames_tell_stands_in_the_summary(server: RunningServer) -> None:
    film = np.full((24, 64, 64), 100, np.uint8)
    film[7] = 2
    assert "the first is number 8" in server.detect(film, no_stabilisation=True).summary[0].warnings[0]
    assert not server.detect(film[:7], no_stabilisation=True).summary[0].warnings
    assert "64 x 64 pixels" in server.detect(film[:7]).summary[0].warnings[0]


def test_an_all_zero_film_has_no_detections(server: RunningServer) -> None:
    assert server.detect(np.zeros((12, 64, 64), np.uint16)).summary[0].kept == 0


def test_region_and_filters_are_obeyed_and_counted(server: RunningServer) -> None:
    film = noise(12, 70, 111)
    anything = {"thresholds": pb.LevelThresholds(), "nms_iou": 1.0, "max_size_px": 1e6}
    everywhere = server.detect(film, **anything)
    assert everywhere.summary[0].kept == everywhere.summary[0].candidates > 0
    mask = np.zeros((70, 111), bool)
    mask[:, :50] = True
    region = pb.RegionOfInterest(mask=np.packbits(mask).tobytes())
    left = server.detect(film, region=region, **anything)
    assert 0 < left.summary[0].kept < everywhere.summary[0].kept
    assert left.summary[0].outside_region == everywhere.summary[0].kept - left.summary[0].kept
    for frame in left.frame:
        assert (rows(frame.detections)[:, [0, 2]].mean(axis=1) <= 50).all()


def test_two_films_at_once_both_come_right_and_the_later_one_hears_that_it_waits(server: RunningServer) -> None:
    films = [noise(60, 240, 320, seed=1), noise(20, 50, 60, seed=2)]
    alone = [server.detect(film, thresholds=LOW) for film in films]
    together: list[Answer | None] = [None, None]
    first = server.call(requests(films[0], thresholds=LOW))
    seen = []
    for response in first:
        seen.append(response)
        if response.progress.stage >= pb.STAGE_STABILISING:
            break

    def second() -> None:
        together[1] = server.detect(films[1], thresholds=LOW)

    thread = threading.Thread(target=second)
    thread.start()
    together[0] = answer([*seen, *first])
    thread.join()
    for lonely, both in zip(alone, together, strict=True):
        assert both is not None
        assert both.frame == lonely.frame
    assert together[1] is not None
    assert max(p.films_ahead for p in together[1].progress) == 1
    assert max(p.films_ahead for p in alone[1].progress) == 0
