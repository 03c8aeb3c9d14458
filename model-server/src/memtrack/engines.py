# SPDX-License-Identifier: GPL-3.0-or-later
"""The engines that run nets on the CPU: OpenVINO (default) and torch (reference, and models without another form)."""

from __future__ import annotations

import importlib
import threading
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import UInt8

from memtrack.detector import Maps
from memtrack.errors import EngineUnavailableError
from memtrack.libraries import load_openvino
from memtrack.refinement import Crops, Estimates


class _OpenVinoNet:
    """A net in OpenVINO's or ONNX form, compiled for the size of the first input it sees.

    `infer` may be called from `threads` threads at a time. batch: how many inputs it takes at once, -1 for any number.
    """

    def __init__(self, path: Path, threads: int, batch: int) -> None:
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
        self._path, self._threads, self._batch = path, threads, batch
        self._lock = threading.Lock()
        self._shape: tuple[int, ...] = ()
        self._compiled: Any = None
        self._local = threading.local()

    def infer(self, inputs: np.ndarray) -> np.ndarray:
        """Outputs of `inputs`, a copy."""
        request = self._request(inputs.shape[1:])
        return np.array(request.infer([inputs], share_inputs=True)[0], np.float32)

    def _request(self, shape: tuple[int, ...]) -> Any:
        with self._lock:
            if shape != self._shape:
                net = self._core.read_model(self._path)
                net.reshape([self._batch, *shape])
                hints = {"INFERENCE_NUM_THREADS": self._threads, "NUM_STREAMS": self._threads}
                # Features are made beside it: a thread bound to one processor would wait for these, the other one idle.
                hints["ENABLE_CPU_PINNING"] = False
                self._compiled, self._shape = self._core.compile_model(net, "CPU", hints), shape
            compiled = self._compiled
        if getattr(self._local, "compiled", None) is not compiled:
            self._local.compiled, self._local.request = compiled, compiled.create_infer_request()
        return self._local.request


class OpenVinoEngine(_OpenVinoNet):
    """The detector by OpenVINO; each of its threads works on a frame of its own."""

    def __init__(self, path: Path, threads: int = 1) -> None:
        super().__init__(path, threads, batch=1)

    def run(self, features: UInt8[np.ndarray, "channel y x"]) -> Maps:
        """See `Engine.run`."""
        return self.infer(features[None])[0]


class OpenVinoRefiner(_OpenVinoNet):
    """The refiner by OpenVINO, for any number of crops at once."""

    def __init__(self, path: Path, threads: int = 1) -> None:
        super().__init__(path, threads, batch=-1)

    def estimates(self, crops: Crops) -> Estimates:
        """See `Refiner.estimates`."""
        return self.infer(crops)


class _TorchNet:
    """A net as it was trained. build: makes one with any weights."""

    def __init__(self, weights: Path, build: Callable[[], Any]) -> None:
        import safetensors.torch
        import torch

        self._torch = torch
        self.net = build()
        self.net.load_state_dict(safetensors.torch.load_file(weights), strict=False)
        self.net.eval()

    def infer(self, inputs: np.ndarray) -> np.ndarray:
        """Outputs of `inputs`."""
        with self._torch.inference_mode():
            outputs: np.ndarray = self.net(self._torch.from_numpy(inputs)).float().numpy()
            return outputs


class TorchEngine(_TorchNet):
    """The detector by torch."""

    def __init__(self, architecture: Mapping[str, Any], channels: int, weights: Path) -> None:
        nets = _importing("memtrack.retinanet")
        super().__init__(weights, lambda: nets.build(architecture, channels))

    def run(self, features: UInt8[np.ndarray, "channel y x"]) -> Maps:
        """See `Engine.run`."""
        return self.infer(features[None])[0]


class TorchRefiner(_TorchNet):
    """The refiner by torch."""

    def __init__(self, widths: Sequence[int], channels: int, weights: Path) -> None:
        nets = _importing("memtrack.centre_net")
        super().__init__(weights, lambda: nets.CentreNet(channels, tuple(widths)))

    def estimates(self, crops: Crops) -> Estimates:
        """See `Refiner.estimates`."""
        return self.infer(crops)


def _importing(nets: str) -> Any:
    """The module `nets`, which needs torch."""
    try:
        return importlib.import_module(nets)
    except ImportError as error:
        raise EngineUnavailableError(
            "the torch engine needs PyTorch: install it with 'pip install memtrack[torch]'"
        ) from error
