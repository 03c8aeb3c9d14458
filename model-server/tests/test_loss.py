# SPDX-License-Identifier: GPL-3.0-or-later
import numpy as np
import torch

from memtrack.retinanet import OUTPUTS
from memtrack.training.loss import LossSettings, detection_loss, targets


def test_targets_of_one_bacterium() -> None:
    out = targets(np.array([[17.5, 9.5, 2, 0]], np.float32), 32, 48, 4, LossSettings(positive_px=3, ring_px=6))
    presence, weight, level, dx, dy = out
    assert out.shape == (5, 8, 12)
    rows, columns = np.nonzero(presence)
    assert set(zip(rows.tolist(), columns.tolist(), strict=True)) == {(2, 4)}  # its centre is (17.5, 9.5)
    assert (level[2, 4], dx[2, 4], dy[2, 4]) == (2, 0, 0)
    assert weight[2, 4] == 1
    assert weight[2, 5] == weight[1, 4] == weight[3, 5] == 0  # 4 and 5.7 px away: unsure
    assert weight[2, 6] == 1
    assert presence[2, 6] == 0


def test_each_place_points_to_its_nearest_bacterium_and_both_neighbours_answer() -> None:
    truth = np.array([[20, 20, 0, 0], [27, 20, 1, 0]], np.float32)
    presence, _, level, dx, _ = targets(truth, 48, 48, 4, LossSettings())
    columns = np.nonzero(presence[4:6].any(axis=0))[0]
    centres = {round(float(1.5 + 4 * c + 4 * dx[r, c]), 3) for r in range(12) for c in columns if presence[r, c]}
    assert centres == {20.0, 27.0}
    assert {int(level[r, c]) for r in range(12) for c in columns if presence[r, c]} == {0, 1}


def test_an_ignored_bacterium_is_neither_present_nor_absent() -> None:
    presence, weight, *_ = targets(np.array([[20, 20, 0, 1]], np.float32), 48, 48, 4, LossSettings())
    assert not presence.any()
    assert weight[4, 4] == 0
    assert weight[11, 11] == 1


def test_nothing_to_find_means_silence_everywhere() -> None:
    presence, weight, *_ = targets(np.zeros((0, 4), np.float32), 32, 32, 4, LossSettings())
    assert not presence.any()
    assert weight.all()


def test_the_loss_falls_when_the_maps_come_nearer() -> None:
    wanted = torch.from_numpy(targets(np.array([[17, 9, 1, 0]], np.float32), 32, 32, 4, LossSettings())[None])
    silent = torch.zeros(1, OUTPUTS, 8, 8)
    silent[:, 0] = -4.0
    right = silent.clone()
    right[:, 0] = torch.where(wanted[:, 0] > 0, 4.0, -4.0)
    right[:, 2] = 3.0
    right[:, 4:] = wanted[:, 3:]
    loud = silent.clone()
    loud[:, 0] = 4.0
    values = [float(detection_loss(maps, wanted, LossSettings())[0]) for maps in (right, silent, loud)]
    assert values == sorted(values)
    assert values[0] < 0.02
