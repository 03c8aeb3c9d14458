# SPDX-License-Identifier: GPL-3.0-or-later
"""What the package computes with: versions of the libraries, devices that work, threads to use."""

from __future__ import annotations

import functools
import importlib.metadata
import importlib.util
import os
import sys
import threading
from typing import Any

import numpy as np

LIBRARIES = ("numpy", "opencv-python-headless", "openvino", "torch", "grpcio", "protobuf", "safetensors")
_FIRST_USE = threading.Lock()


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


@functools.cache
def _openvino() -> Any:
    import openvino
    import openvino.opset13

    net = _probe(openvino)
    openvino.Core().compile_model(net, "CPU")([np.array([-1, 1], np.float32)])
    return openvino


def load_openvino() -> Any:
    """The module `openvino`, after one operation on the CPU.

    Its first operation builds tables while it lets go of Python's lock; a second thread that comes to them at that
    moment holds the lock and waits for the tables for ever (6 of 40 processes that began with two threads at once hung,
    with 2026.4.1). So the first operation is done here, by one thread, whoever asks.

    Raises:
        ImportError: it is not installed.
    """
    with _FIRST_USE:
        return _openvino()


def _probe(openvino: Any) -> Any:
    """A net of one operation: two numbers, the negative ones set to 0."""
    value = openvino.opset13.parameter([2], np.float32)
    return openvino.Model([openvino.opset13.relu(value)], [value], "probe")


def _openvino_devices() -> list[str]:
    try:
        openvino = load_openvino()
    except ImportError:
        return []
    working = []
    core = openvino.Core()
    for device in core.available_devices:
        try:
            net = core.compile_model(_probe(openvino), device)
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
