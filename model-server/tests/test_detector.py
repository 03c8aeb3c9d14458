# SPDX-License-Identifier: GPL-3.0-or-later
import sys

import numpy as np
import pytest

from memtrack import libraries
from memtrack.channels import NEUTRAL
from memtrack.detector import Decoder, detect, padded
from memtrack.engines import OpenVinoEngine
from memtrack.errors import EngineUnavailableError, SettingsError
from memtrack.models import load_model
from memtrack.pruning import PrunerSettings, prune


class Fixed:
    """An engine whose answer is known."""

    def __init__(self, maps: np.ndarray) -> None:
        self.maps = maps

    def run(self, features: np.ndarray) -> np.ndarray:
        assert features.shape[1] % 16 == 0
        assert features.shape[2] % 16 == 0
        return self.maps


def silent(rows: int = 8, columns: int = 12) -> np.ndarray:
    maps = np.zeros((6, rows, columns), np.float32)
    maps[0] = -10
    return maps


def test_a_place_and_its_offset_become_a_box_of_the_cards_size() -> None:
    maps = silent()
    maps[0, 3, 5] = 2.0
    maps[1:4, 3, 5] = [0.1, 0.7, 0.2]
    maps[4:, 3, 5] = [0.25, -0.5]
    found = Decoder(slope=2.0, offset=-1.0, box_size_px=20).decode(maps, 32, 48)
    np.testing.assert_allclose(found.boxes, [[5.25 * 4 + 1.5 - 10, 2.5 * 4 + 1.5 - 10, 32.5, 21.5]])
    np.testing.assert_allclose(found.scores, 1 / (1 + np.exp(-3.0)), rtol=1e-6)
    assert list(found.levels) == [1]


def test_places_that_point_to_one_bacterium_agree_on_a_mean_weighted_by_score() -> None:
    maps = silent()
    maps[0, 3, 5], maps[4, 3, 5] = 2.0, 0.5  # points to x = 23.5
    maps[0, 3, 6], maps[4, 3, 6] = 0.0, -0.25  # points to x = 24.5
    maps[0, 3, 9] = 0.0  # another bacterium
    found = Decoder().decode(maps, 32, 48)
    centres = (found.boxes[:, 0] + found.boxes[:, 2]) / 2
    strong = 1 / (1 + np.exp(-2.0))
    expected = (23.5 * strong + 24.5 * 0.5) / (strong + 0.5)
    np.testing.assert_allclose(centres, [expected, expected, 37.5], atol=1e-5)


def test_both_ends_of_a_bacterium_become_one_and_a_neighbour_stays_another() -> None:
    maps = silent()
    for column, logit in ((2, 1.0), (4, 2.0), (7, 1.5)):  # x = 9.5, 17.5 and 29.5
        maps[0, 3, column] = logit
    maps[4, 3, 2] = 0.25  # points to x = 10.5, 7 px from the best one
    found = Decoder().decode(maps, 32, 48)
    centres = (found.boxes[:, 0] + found.boxes[:, 2]) / 2
    np.testing.assert_allclose(centres, [17.5, 17.5, 29.5], atol=1e-5)
    centres = (Decoder(distinct_px=6).decode(maps, 32, 48).boxes[:, ::2] / 2).sum(axis=1)
    np.testing.assert_allclose(centres, [10.5, 17.5, 29.5], atol=1e-5)


def test_nothing_is_found_in_the_padding() -> None:
    maps = silent()
    maps[0] = 5
    found = Decoder().decode(maps, 10, 21)
    centres = found.centres
    assert len(found) == 15  # places 0 to 4 by 0 to 2 have centres in the frame
    assert centres.max(axis=0)[0] < 21
    assert centres.max(axis=0)[1] < 10


def test_features_are_padded_with_neutral_values() -> None:
    features = np.zeros((2, 17, 16), np.uint8)
    padded(np.full((2, 20, 16), 7, np.uint8))  # another film of the same size once padded
    out = padded(features)
    assert out.shape == (2, 32, 16)
    assert (out[:, 17:] == NEUTRAL).all()
    assert not out[:, :17].any()


def test_a_flood_of_candidates_is_cut_to_the_best() -> None:
    maps = np.zeros((6, 100, 100), np.float32)
    maps[0] = np.linspace(-1, 1, 10000).reshape(100, 100)
    found = detect(Fixed(maps), Decoder(), np.zeros((1, 400, 400), np.uint8))
    assert len(found) == 1500
    assert found.scores.min() > 1 / (1 + np.exp(-0.69))


def test_a_large_frame_keeps_the_candidates_of_all_its_bacteria() -> None:
    """1100 bacteria in 2048 x 2048 pixels, of four places each."""
    maps = silent(512, 512)
    rows, columns = np.divmod(np.arange(1100) * 225, 500)
    for down, right in ((0, 0), (0, 1), (1, 0), (1, 1)):
        maps[0, rows + down, columns + right] = 2.0
        maps[4, rows + down, columns + right] = 0.5 - right
        maps[5, rows + down, columns + right] = 0.5 - down
    found = Decoder().decode(maps, 2048, 2048)
    assert len(found) == 4400
    centres = found.centres
    expected = np.stack([columns, rows], axis=1) * 4 + 3.5
    np.testing.assert_allclose(np.unique(centres, axis=0), np.unique(expected, axis=0), atol=1e-3)
    kept, _ = prune(found, PrunerSettings((0.5, 0.5, 0.5)))
    assert len(kept) == 1100


def test_both_engines_of_the_shipped_model_agree() -> None:
    pytest.importorskip("torch")
    model = load_model()
    rng = np.random.default_rng(0)
    features = np.full((len(model.card.features.channels), 64, 96), NEUTRAL, np.uint8)
    features[:6] = np.clip(rng.normal(NEUTRAL, 10, (6, 64, 96)), 0, 255)
    features[1, 30:36, 40:46] = 220
    reference, quick = model.engine("torch").run(features), model.engine("openvino").run(features)
    assert reference.shape == quick.shape == (6, 16, 24)
    score = 1 / (1 + np.exp(-reference[0]))
    assert score.max() > 0.3
    # 8-bit arithmetic: scores agree to a tenth, the centre of what was found to half a pixel.
    assert np.abs(1 / (1 + np.exp(-quick[0])) - score).max() < 0.12
    assert np.abs(quick[4:] - reference[4:])[:, score > 0.3].max() * 4 < 0.75


def test_an_engine_nobody_made_is_refused() -> None:
    with pytest.raises(SettingsError, match="engine 'tpu' is unknown"):
        load_model().engine("tpu")


def test_a_missing_openvino_is_said_in_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    # Other tests have loaded it already, and it is loaded once.
    monkeypatch.setattr("memtrack.libraries._openvino", libraries._openvino.__wrapped__)
    monkeypatch.setitem(sys.modules, "openvino", None)
    with pytest.raises(EngineUnavailableError, match="install it with"):
        OpenVinoEngine(load_model().folder / "openvino.xml")


def test_openvino_that_cannot_be_loaded_says_what_it_misses(monkeypatch: pytest.MonkeyPatch) -> None:
    def load() -> None:
        raise ImportError("DLL load failed while importing _pyopenvino")

    monkeypatch.setattr("memtrack.engines.load_openvino", load)
    with pytest.raises(EngineUnavailableError, match=r"DLL load failed.*Visual C\+\+ Redistributable"):
        OpenVinoEngine(load_model().folder / "openvino.xml")
