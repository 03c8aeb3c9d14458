# SPDX-License-Identifier: GPL-3.0-or-later
"""Sends one long film through a real server: frames a second of each stage, and the server's greatest memory.

    python benchmarks/film_through_server.py [--frames 7200] [--width 660] [--height 492] [--dtype uint8]

The film repeats 60 frames of noise with moving bars, so that it needs no memory in the client. Transport alone is the
stage RECEIVING: one hop over the loopback, chunks of 1 MiB, hashing and the spool included.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import psutil

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from memtrack.v1 import detection_pb2 as pb
from server.running import PIXEL_TYPES, RunningServer, noise


def main() -> None:
    """Runs the benchmark and prints one line a stage."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default in (("frames", 7200), ("width", 660), ("height", 492)):
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--dtype", choices=sorted(PIXEL_TYPES), default="uint8")
    parser.add_argument("--receive-only", action="store_true", help="cancel once the film has arrived")
    options = parser.parse_args()
    film = [f.tobytes() for f in noise(60, options.height, options.width, options.dtype)]
    with (
        tempfile.TemporaryDirectory() as folder,
        RunningServer(Path(folder)) as server,
        _PeakMemory(server.process.pid) as memory,
    ):
        begun = time.monotonic()
        responses = server.detection.DetectFilm(_requests(film, options), metadata=server.metadata)
        arrived, detections = 0.0, 0
        for response in responses:
            detections += len(response.frame.detections)
            if response.progress.stage == pb.STAGE_RECEIVING:
                arrived = time.monotonic() - begun
            if response.progress.stage > pb.STAGE_RECEIVING and options.receive_only:
                responses.cancel()
                break
        seconds = time.monotonic() - begun
    size = options.frames * len(film[0])
    print(f"film: {options.frames} frames of {options.width} x {options.height} {options.dtype}, {size / 1e9:.2f} GB")
    print(f"receiving: {arrived:.1f} s, {options.frames / arrived:.0f} frames/s, {size / arrived / 1e6:.0f} MB/s")
    if not options.receive_only:
        for stage in response.summary.stage_times:
            name = pb.Stage.Name(stage.stage).removeprefix("STAGE_").lower()
            print(f"{name}: {stage.seconds:.1f} s, {options.frames / stage.seconds:.0f} frames/s")
        print(f"whole: {seconds:.1f} s, {options.frames / seconds:.1f} frames/s; {detections} detections")
    print(f"greatest resident memory of the server: {memory.peak / 1e6:.0f} MB")


def _requests(film: list[bytes], options: argparse.Namespace) -> Iterator[pb.DetectFilmRequest]:
    yield pb.DetectFilmRequest(
        header=pb.FilmHeader(
            protocol=1,
            width=options.width,
            height=options.height,
            frame_count=options.frames,
            pixel_type=PIXEL_TYPES[options.dtype],
        )
    )
    for i in range(options.frames):
        data = film[i % len(film)]
        for start in range(0, len(data), 1 << 20):
            yield pb.DetectFilmRequest(chunk=pb.FrameChunk(frame=i, data=data[start : start + (1 << 20)]))


class _PeakMemory:
    """The greatest resident memory of a process during a `with` block, sampled ten times a second."""

    def __init__(self, pid: int) -> None:
        self._process = psutil.Process(pid)
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._sample, daemon=True)
        self.peak = 0

    def __enter__(self) -> _PeakMemory:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._thread.join()

    def _sample(self) -> None:
        while not self._over.wait(0.1):
            self.peak = max(self.peak, self._process.memory_info().rss)


if __name__ == "__main__":
    main()
