# SPDX-License-Identifier: GPL-3.0-or-later
"""What the package computes with: versions of the libraries, devices that work, threads to use."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import sys

import numpy as np

LIBRARIES = ("numpy", "opencv-python-headless", "openvino", "torch", "grpcio", "protobuf", "safetensors")


def engine_threads() -> int:
    """Threads for the detection on this machine: the processors this process may use, at most 8."""
    return min(8, len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1)


def library_versions() -> dict[str, str]:
    """Installed versions of the libraries the server builds on; nothing is imported for it."""
    versions = {}
    for name in LIBRARIES:
        try:
            versions[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            continue
    return versions


def working_devices() -> list[str]:
    """Devices that carried out one operation, as "library device"."""
    return [*_openvino_devices(), *_torch_devices()]


def _openvino_devices() -> list[str]:
    if importlib.util.find_spec("openvino") is None:
        return []
    import openvino
    from openvino import opset13

    working = []
    core = openvino.Core()
    for device in core.available_devices:
        try:
            value = opset13.parameter([2], np.float32)
            net = core.compile_model(openvino.Model([opset13.relu(value)], [value], "probe"), device)
            if np.array_equal(net([np.array([-1, 1], np.float32)])[0], [0, 1]):
                working.append(f"openvino {device}")
        except RuntimeError:
            continue
    return working


def _torch_devices() -> list[str]:
    if importlib.util.find_spec("torch") is None:
        return []
    import torch

    names = ["cpu"]
    names += [f"cuda:{i}" for i in range(torch.cuda.device_count())]
    names += ["mps"] if torch.backends.mps.is_available() else []
    working = []
    for name in names:
        try:
            if torch.ones(2, device=name).sum().item() == 2:
                working.append(f"torch {name}")
        except RuntimeError:
            continue
    return working
