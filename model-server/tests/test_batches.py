# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np

from memtrack.motion import FeatureSpec
from memtrack.training.batches import Batches
from memtrack.training.loss import LossSettings
from spots import samples


def test_flips_and_transposes_move_pixels_and_truth_alike() -> None:
    film = samples([[20, 37, 0, 0]])
    spec = FeatureSpec("t", 1, ("flow", "spread"))
    batches = Batches([film], spec, crop=48, size=32, stride=4, loss=LossSettings())
    features, wanted, chosen = batches.draw(np.random.default_rng(0))
    assert not chosen.any()
    seen = 0
    for crop, target in zip(features, wanted, strict=True):
        spots = np.argwhere(crop[0] == 255)
        places = np.argwhere(target[0] > 0)
        assert len(spots) <= 1
        if len(spots) and len(places):
            r, c = places[0]
            centre = (1.5 + 4 * (c + target[3, r, c]), 1.5 + 4 * (r + target[4, r, c]))
            np.testing.assert_allclose(centre, spots[0][::-1], atol=1e-3)
            seen += 1
    assert seen > 10


def test_films_the_net_fails_on_are_drawn_more_often() -> None:
    films = [samples([[10, 10, 0, 0]]) for _ in range(4)]
    batches = Batches(films, FeatureSpec("t", 1, ("flow", "spread")), crop=48, size=16, stride=4, loss=LossSettings())
    for _ in range(20):
        batches.learned(np.arange(4), np.array([0.1, 0.1, 0.1, 5.0], np.float32))
    drawn = np.concatenate([batches.draw(np.random.default_rng(k))[2] for k in range(20)])
    assert (drawn == 3).mean() > 0.5
