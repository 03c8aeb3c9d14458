# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
import pytest

from memtrack.channels import NEUTRAL
from memtrack.errors import SettingsError
from memtrack.motion import MOTION
from memtrack.refinement import EDGE_PX
from memtrack.training.centres import NUDGE_PX, CentreSamples, augmented, optimise_centres
from memtrack.training.config import Refinement

torch = pytest.importorskip("torch")
SIGNED = np.array([name != "spread" for name in MOTION.channels])


def spots(count: int, rng: np.random.Generator) -> CentreSamples:
    """Crops of one round spot each, near their middle."""
    edge = EDGE_PX + 2 * NUDGE_PX
    offsets = rng.normal(0, 0.7, (count, 2)).clip(-2, 2).astype(np.float32)
    y, x = np.mgrid[:edge, :edge] - edge // 2
    distance = np.square(x - offsets[:, 0, None, None]) + np.square(y - offsets[:, 1, None, None])
    values = NEUTRAL + 100 * np.exp(-distance / 8) + rng.normal(0, 3, distance.shape)
    crops = np.full((count, len(MOTION.channels), edge, edge), NEUTRAL, np.uint8)
    crops[:, 1] = values.clip(0, 255)
    return CentreSamples(crops, offsets, np.arange(count) // 4)


def test_flips_and_nudges_keep_the_truth_on_the_bacterium() -> None:
    rng = np.random.default_rng(1)
    samples = spots(200, rng)
    crops, offsets = augmented(samples.crops, samples.offsets, SIGNED, rng)
    light = np.abs(crops[:, 1].astype(float) - NEUTRAL) ** 2
    light[light < 30**2] = 0
    pixels = np.arange(EDGE_PX) - EDGE_PX // 2
    middle = (
        np.stack([light.sum(axis=1) @ pixels, light.sum(axis=2) @ pixels], axis=1) / light.sum(axis=(1, 2))[:, None]
    )
    np.testing.assert_allclose(middle, offsets, atol=0.2)
    # All directions, both signs, and the unsigned channel as it was.
    assert len(np.unique(np.sign(offsets), axis=0)) == 4
    assert 0.3 < (crops[:, 1, 6:-6, 6:-6].min(axis=(1, 2)) < 60).mean() < 0.7
    assert (crops[:, MOTION.channels.index("spread")] == NEUTRAL).all()


def test_what_is_learnt_is_where_the_bacterium_is() -> None:
    rng = np.random.default_rng(2)
    settings = Refinement(iterations=120, batch=32, widths=(4, 8, 8), learning_rate=3e-3, average=0.9, bfloat16=False)
    net = optimise_centres(settings, spots(400, rng), MOTION, "cpu", lambda line: None).eval()
    unseen = spots(100, rng)
    crops = unseen.crops[:, :, NUDGE_PX:-NUDGE_PX, NUDGE_PX:-NUDGE_PX]
    with torch.inference_mode():
        out = net(torch.from_numpy(np.ascontiguousarray(crops))).numpy()
    before, after = (np.sqrt(np.square(e).mean()) for e in (unseen.offsets, unseen.offsets - out[:, :2]))
    assert after < 0.25 < 0.6 < before


def test_a_loss_that_is_no_number_ends_the_training_of_centres_at_once() -> None:
    settings = Refinement(iterations=9, batch=8, widths=(4, 8, 8), learning_rate=1e30)
    said: list[str] = []
    with pytest.raises(
        SettingsError, match=r"the loss is no number after iteration \d+: lower learning_rate in \[refin"
    ):
        optimise_centres(settings, spots(40, np.random.default_rng(2)), MOTION, "cpu", said.append)
