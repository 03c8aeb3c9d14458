# SPDX-License-Identifier: GPL-3.0-or-later
"""A model server in a process of its own, a client for it, and small films to send."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Any

import grpc
import numpy as np

from memtrack.v1 import detection_pb2 as pb
from memtrack.v1 import detection_pb2_grpc, server_pb2_grpc

TOKEN = "a token for tests"
PIXEL_TYPES = {"uint8": pb.PIXEL_TYPE_UINT8, "uint16": pb.PIXEL_TYPE_UINT16, "float32": pb.PIXEL_TYPE_FLOAT32}
PATIENCE_SECONDS = 30.0


def eventually(condition: Callable[[], bool], what: str, seconds: float = PATIENCE_SECONDS) -> None:
    """Waits until `condition` holds; fails after `seconds`."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"not within {seconds:g} s: {what}"
        time.sleep(0.02)


class RunningServer:
    """`memtrack serve` as a child process; ends with the `with` block."""

    def __init__(
        self, spool_folder: Path, *options: str, token: str | None = TOKEN, environment: dict[str, str] | None = None
    ) -> None:
        self.spool_folder = spool_folder
        self.token = token
        words = [sys.executable, "-m", "memtrack", "serve", "--spool-folder", str(spool_folder), *options]
        with (spool_folder / "server.log").open("ab") as log:
            self.process = subprocess.Popen(
                words + ["--token-from-stdin"] * (token is not None),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                env={**os.environ, **(environment or {})},
                encoding="utf-8",
            )
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        if token is not None:
            self.process.stdin.write(f"{token}\n")
            self.process.stdin.flush()
        self.first_line = self.process.stdout.readline()

    def __enter__(self) -> RunningServer:
        self.hello: dict[str, Any] = json.loads(self.first_line)
        self.address = f"127.0.0.1:{self.hello['port']}"
        self.channel = grpc.insecure_channel(self.address, [("grpc.enable_http_proxy", 0)])
        self.detection = detection_pb2_grpc.DetectionServiceStub(self.channel)
        self.server = server_pb2_grpc.ServerServiceStub(self.channel)
        self.metadata = [] if self.token is None else [("authorization", f"Bearer {self.token}")]
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.channel.close()
        self.end()

    def end(self) -> int:
        """Closes the server's standard input and waits for its end; returns its exit code."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.close()
        try:
            code = self.process.wait(PATIENCE_SECONDS)
        finally:
            self.process.kill()
            self.process.wait()
            self.process.stdout.close()
        return code

    @property
    def log(self) -> str:
        """What the server has written to standard error."""
        return (self.spool_folder / "server.log").read_text(encoding="utf-8")

    def spools(self) -> int:
        """Films the server holds on disk, those without a name too (which Linux tells of)."""
        named = list(self.spool_folder.glob("memtrack-spool-*"))
        descriptors = Path(f"/proc/{self.process.pid}/fd")
        if not descriptors.is_dir():
            return len(named)
        targets = []
        for descriptor in descriptors.iterdir():
            try:
                targets.append(str(descriptor.readlink()))
            except OSError:
                continue
        return sum(target.startswith(str(self.spool_folder)) and "server.log" not in target for target in targets)

    def call(self, requests: Iterable[pb.DetectFilmRequest]) -> Any:
        """A call of DetectFilm; iterate over it for the responses."""
        return self.detection.DetectFilm(iter(requests), metadata=self.metadata, timeout=2 * PATIENCE_SECONDS)

    def detect(self, film: np.ndarray, **fields: Any) -> Answer:
        """Everything the server answers to `film`."""
        return answer(self.call(requests(film, **fields)))


@dataclass
class Answer:
    """The responses to one film, sorted by kind."""

    accepted: list[pb.Accepted] = field(default_factory=list)
    progress: list[pb.Progress] = field(default_factory=list)
    frame: list[pb.FrameDetections] = field(default_factory=list)
    summary: list[pb.Summary] = field(default_factory=list)
    order: list[str] = field(default_factory=list)


def answer(responses: Iterable[pb.DetectFilmResponse]) -> Answer:
    """Reads all responses."""
    found = Answer()
    for response in responses:
        kind = response.WhichOneof("message")
        assert kind is not None
        getattr(found, kind).append(getattr(response, kind))
        found.order.append(kind)
    return found


def check_order(found: Answer, frames: int) -> None:
    """One acceptance, then every frame once and in order, then one summary."""
    assert found.order[0] == "accepted"
    assert found.order[-1] == "summary"
    assert (len(found.accepted), len(found.summary)) == (1, 1)
    assert [f.frame for f in found.frame] == list(range(frames))


def noise(frames: int, height: int, width: int, dtype: str = "uint8", seed: int = 0) -> np.ndarray:
    """A film of camera noise with a few dark bars that move; values fit into 8 bits."""
    world = np.random.default_rng(seed)
    film = world.normal(120, 4, (frames, height, width))
    for i in range(frames):
        for x, y in ((3 + i, height // 3), (width - 8 - i, height // 2)):
            film[i, y : y + 3, max(x, 0) % width : max(x, 0) % width + 7] -= 60
    return film.clip(0, 255).astype(dtype)


def header(film: np.ndarray, **fields: Any) -> pb.FilmHeader:
    """The header that tells of `film`; `fields` replace or add to it."""
    frames, height, width = film.shape
    values: dict[str, Any] = {
        "protocol": 1,
        "width": width,
        "height": height,
        "frame_count": frames,
        "pixel_type": PIXEL_TYPES[film.dtype.name],
        **fields,
    }
    return pb.FilmHeader(**values)


def chunks(film: np.ndarray, size: int = 1 << 20, first: int = 0) -> Iterator[pb.DetectFilmRequest]:
    """The frames of `film` in chunks of up to `size` bytes."""
    for i, frame in enumerate(film):
        data = frame.astype(frame.dtype.newbyteorder("<")).tobytes()
        for start in range(0, len(data), size):
            yield pb.DetectFilmRequest(chunk=pb.FrameChunk(frame=first + i, data=data[start : start + size]))


def requests(film: np.ndarray, size: int = 1 << 20, **fields: Any) -> Iterator[pb.DetectFilmRequest]:
    """All a client sends for `film`."""
    yield pb.DetectFilmRequest(header=header(film, **fields))
    yield from chunks(film, size)
