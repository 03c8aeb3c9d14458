# SPDX-License-Identifier: GPL-3.0-or-later
"""The engines that run a net on the CPU: OpenVINO (default) and torch (reference, and models without another form)."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import UInt8

from memtrack.detector import Maps
from memtrack.errors import EngineUnavailableError
from memtrack.libraries import load_openvino


class OpenVinoEngine:
    """A net in OpenVINO's or ONNX form, compiled for the size of the first frame it sees.

    `run` may be called from `threads` threads at a time, each of which works on a frame of its own.
    """

    def __init__(self, path: Path, threads: int = 1) -> None:
        try:
            openvino = load_openvino()
        except ModuleNotFoundError as error:
            raise EngineUnavailableError(
                "the CPU engine needs OpenVINO: install it with 'pip install openvino'"
            ) from error
        except ImportError as error:  # seen where its libraries miss one of the system's
            raise EngineUnavailableError(
                f"OpenVINO is installed but cannot be loaded ({error}): on Windows install the Microsoft Visual C++ "
                "Redistributable, elsewhere install openvino anew"
            ) from error
        self._core = openvino.Core()
        self._path, self._threads = path, threads
        self._lock = threading.Lock()
        self._shape: tuple[int, ...] = ()
        self._compiled: Any = None
        self._local = threading.local()

    def run(self, features: UInt8[np.ndarray, "channel y x"]) -> Maps:
        """See `Engine.run`."""
        request = self._request(features.shape)
        return np.array(request.infer([features[None]], share_inputs=True)[0][0], np.float32)

    def _request(self, shape: tuple[int, ...]) -> Any:
        with self._lock:
            if shape != self._shape:
                net = self._core.read_model(self._path)
                net.reshape([1, *shape])
                hints = {"INFERENCE_NUM_THREADS": self._threads, "NUM_STREAMS": self._threads}
                self._compiled, self._shape = self._core.compile_model(net, "CPU", hints), shape
            compiled = self._compiled
        if getattr(self._local, "compiled", None) is not compiled:
            self._local.compiled, self._local.request = compiled, compiled.create_infer_request()
        return self._local.request


class TorchEngine:
    """The net as it was trained."""

    def __init__(self, architecture: Mapping[str, Any], channels: int, weights: Path) -> None:
        try:
            import safetensors.torch
            import torch
        except ImportError as error:
            raise EngineUnavailableError(
                "the torch engine needs PyTorch: install it with 'pip install memtrack[torch]'"
            ) from error
        from memtrack.retinanet import build

        self._torch = torch
        self.net = build(architecture, channels)
        self.net.load_state_dict(safetensors.torch.load_file(weights), strict=False)
        self.net.eval()

    def run(self, features: UInt8[np.ndarray, "channel y x"]) -> Maps:
        """See `Engine.run`."""
        with self._torch.inference_mode():
            maps: Maps = self.net(self._torch.from_numpy(features[None]))[0].float().numpy()
            return maps
