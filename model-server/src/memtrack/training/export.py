# SPDX-License-Identifier: GPL-3.0-or-later
"""A trained net as files of the registry: weights in safetensors, and an OpenVINO form with 8-bit arithmetic."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import safetensors.torch
import torch
from torch import nn


def export(
    net: nn.Module, inputs: Sequence[np.ndarray], weights: Path, graph: Path, *, quantise: bool
) -> dict[str, Path]:
    """Writes the files `weights` and `graph`, and what belongs to the graph beside it.

    Args:
        net: the net, in any mode, on any device.
        inputs: some that the net takes, [n, channel, y, x]: they set the ranges of 8-bit numbers.
        weights, graph: in existing folders.
        quantise: 8-bit convolutions in the graph; False keeps 32-bit ones.

    Returns:
        Path of each file by its name in the registry.
    """
    import nncf
    import openvino

    net = net.cpu().float().eval().to(memory_format=torch.contiguous_format)
    state = {
        name: value.contiguous() for name, value in net.state_dict().items() if not name.endswith("num_batches_tracked")
    }
    safetensors.torch.save_file(state, weights)
    with torch.inference_mode():
        converted = openvino.convert_model(net, example_input=torch.from_numpy(inputs[0]))
    converted.reshape([inputs[0].shape[0], inputs[0].shape[1], -1, -1])
    if quantise:
        converted = nncf.quantize(converted, nncf.Dataset(inputs), subset_size=len(inputs))
    openvino.save_model(converted, graph, compress_to_fp16=True)
    return {path.name: path for path in (weights, graph, graph.with_suffix(".bin"))}
