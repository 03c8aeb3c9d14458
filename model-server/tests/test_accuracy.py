# SPDX-License-Identifier: GPL-3.0-or-later
"""The accuracy benchmark: its films are nobody else's, and its tables say what was measured."""

from __future__ import annotations

import itertools
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import tifffile
from accuracy.films import FIRST_SEED, SIMULATED, Made, Simulated
from accuracy.peers import NAMES, spot_detectors
from accuracy.scores import OURS, Examined, score, tables

from memtrack.film import ArrayFilm
from memtrack.tracks import TrackTable

RECIPES = sorted((Path(__file__).parents[1] / "recipes").glob("*.toml"))
TINY = Simulated("tiny", "collagen", 1, size=(120, 100), frames=20)


def straight(speed: float, *, frames: int = 20, y: float = 20.0) -> TrackTable:
    """One cell that moves to the right."""
    t = np.arange(frames)
    return TrackTable.of(t, 0, 10 + speed * t, y)


def test_no_recipe_uses_a_seed_of_the_examined_films() -> None:
    examined = {seed for film in SIMULATED for seed in itertools.islice(film.seeds(), 100)}
    sets = [entry for recipe in RECIPES for kind in ("training", "validation") for entry in _sets(recipe, kind)]
    assert len(sets) >= 8
    for entry in sets:
        assert examined.isdisjoint(range(entry["seed"], entry["seed"] + entry["count"]))
    assert len({film.name for film in SIMULATED}) == len(SIMULATED)


def _sets(recipe: Path, kind: str) -> list[dict[str, int]]:
    content = tomllib.loads(recipe.read_text(encoding="utf-8"))
    return list(content.get(kind, []))


def test_a_film_is_the_same_every_time_and_lies_on_the_disk_as_it_is_examined(tmp_path: Path) -> None:
    with TINY.made(tmp_path) as film:
        assert (tifffile.imread(film.path) == TINY.simulate().film.frames).all()
        assert film.least_lengths == (10, 5)
        assert (film.preset, film.film.width, film.film.frame_count) == ("collagen", 120, 20)


def test_films_drawn_anew_are_others_and_touch_no_seed_of_the_first() -> None:
    film, anew = (replace(SIMULATED[0], size=(64, 48), cells=None, first_seed=seed) for seed in (FIRST_SEED, 7_000_000))
    assert set(itertools.islice(film.seeds(), 50)).isdisjoint(itertools.islice(anew.seeds(), 50))
    assert (film.simulate().film.frame(0) != anew.simulate().film.frame(0)).any()


def test_scores_of_tracks_beside_the_truth() -> None:
    truth = straight(3.0)
    perfect = score(truth, truth)
    assert (perfect.f1, perfect.hota, perfect.f1_near, perfect.rms_px) == (1.0, 1.0, 1.0, 0.0)
    assert (perfect.speed_ratio, perfect.net_speed_ratio) == (1.0, 1.0)
    beside = score(truth, straight(3.3, y=22.0))
    assert beside.f1 == 1.0
    assert beside.f1_near == pytest.approx(0.95)  # only in the last frame is it 6 px away
    assert beside.rms_px == pytest.approx(np.sqrt(4 + 0.09 * np.mean(np.arange(20) ** 2)))
    assert (beside.speed_ratio, beside.net_speed_ratio) == pytest.approx((1.1, 1.1))
    nothing = score(truth, truth.select(np.zeros(20, np.bool_)))
    assert (nothing.recall, nothing.f1, nothing.hota, nothing.tracks) == (0.0, 0.0, 0.0, 0)


def test_long_tracks_on_an_empty_film_are_counted() -> None:
    nothing = straight(0.0).select(np.zeros(20, np.bool_))
    assert [score(nothing, straight(1.0, frames=n)).long_tracks for n in (59, 60)] == [0, 1]


def test_the_tables_have_a_row_a_film_and_a_column_a_method() -> None:
    truth = straight(3.0)
    ours = score(truth, truth, "model test 1")
    films = [
        Examined("first", "foam", 1.0, "", {"other": replace(ours, f1=0.5, hota=0.25), OURS: ours}),
        Examined("second", "foam", 1.0, "", {OURS: replace(ours, f1=0.9), "other": replace(ours, f1=0.0, hota=0.0)}),
        Examined("nothing", "foam", 0.0, "", {OURS: replace(ours, tracks=3, long_tracks=2)}),
    ]
    text = tables(films)
    assert text.startswith(f"{OURS} with model test 1:\n\n| film | shows | cells a frame | precision |")
    assert "| first | foam | 1 | 1.000 | 1.000 | 1.000 | 1.000 | 0.00 px | 1.000 | +0.0 % | +0.0 % |" in text
    assert "| second | 0.900 / 1.000 | 0.000 / 0.000 |" in text
    assert "| mean of 2 | 0.950 / 1.000 | 0.250 / 0.125 |" in text
    assert "| nothing | foam | 3 | 2 |" in text


def test_the_peers_find_spots_that_anyone_finds() -> None:
    pytest.importorskip("trackpy", reason="the extra 'baselines' is not installed")
    y, x = np.mgrid[:80, :100]
    t, k = (column.ravel() for column in np.mgrid[:20, :4])
    truth = TrackTable.of(t, k, 10 + (3 + 0.3 * k) * t, 10 + 20 * k)
    frames = np.full((20, 80, 100), 100.0)
    for frame, cx, cy in zip(truth.frames, truth.x, truth.y, strict=True):
        frames[frame] += 80 * np.exp(-((x - cx) ** 2 + (y - cy) ** 2) / 8)
    frames += np.random.default_rng(1).normal(0, 2, frames.shape)
    film = Made("spots", "spots", Path("none.tif"), ArrayFilm(frames.clip(0, 255).astype(np.uint8)), truth, "water")
    found = spot_detectors(film)
    assert list(found) == list(NAMES.values())
    for scores in found.values():
        assert scores.f1 > 0.98
        assert scores.rms_px < 0.5
        assert scores.how.endswith((", 10 frames", ", 5 frames"))
