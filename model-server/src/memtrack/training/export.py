# SPDX-License-Identifier: GPL-3.0-or-later
"""A trained net as files of the registry: weights in safetensors, and an OpenVINO form with 8-bit arithmetic."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import safetensors.torch
import torch
from torch import nn

from memtrack.models import OPENVINO, WEIGHTS


def export(net: nn.Module, samples: Iterable[np.ndarray], folder: Path, *, quantise: bool = True) -> dict[str, Path]:
    """Writes the net's files into `folder`.

    Args:
        net: the net, in any mode, on any device.
        samples: features [channel, y, x] of typical frames, which set the ranges of the 8-bit numbers.
        folder: an existing folder.
        quantise: 8-bit convolutions; False keeps 32-bit ones.

    Returns:
        Path of each file by its name in the registry.
    """
    import nncf
    import openvino

    net = net.cpu().float().eval().to(memory_format=torch.contiguous_format)
    state = {
        name: value.contiguous() for name, value in net.state_dict().items() if not name.endswith("num_batches_tracked")
    }
    safetensors.torch.save_file(state, folder / WEIGHTS)
    batch = [sample[None] for sample in samples]
    with torch.inference_mode():
        graph = openvino.convert_model(net, example_input=torch.from_numpy(batch[0]))
    graph.reshape([1, batch[0].shape[1], -1, -1])
    if quantise:
        graph = nncf.quantize(graph, nncf.Dataset(batch), subset_size=len(batch))
    openvino.save_model(graph, folder / OPENVINO, compress_to_fp16=True)
    names = (WEIGHTS, OPENVINO, Path(OPENVINO).with_suffix(".bin").name)
    return {name: folder / name for name in names}
