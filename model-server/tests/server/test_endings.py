# SPDX-License-Identifier: GPL-3.0-or-later
"""How films and servers end: cancelled, killed, idle, told to; the spool is gone every time."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import grpc
import numpy as np
import psutil
import pytest
from grpc_health.v1 import health_pb2, health_pb2_grpc

from memtrack.v1 import detection_pb2 as pb
from server.running import PATIENCE_SECONDS, RunningServer, answer, chunks, eventually, header, noise, requests

CANCEL_SECONDS = 2.0
"""What the manual promises of a film whose client has cancelled it, is gone, or is silent."""


@pytest.fixture(scope="module")
def long_film() -> np.ndarray:
    """Long enough that every stage can be caught at work, and that who goes on to its end is seen to."""
    return np.tile(noise(20, 300, 400), (30, 1, 1))


def finished(server: RunningServer, film: np.ndarray) -> bool:
    """Whether a film of the size of `film` was worked on to its end."""
    frames, height, width = film.shape
    return f"{frames} frames of {width} x {height}: " in server.log


def until(call: Any, stage: int) -> None:
    """Reads responses until `stage` is at work."""
    for response in call:
        if response.progress.stage >= stage:
            assert response.progress.stage == stage, "the film was too short to catch the stage"
            return
    pytest.fail("the film ended before the stage")


def endless(film: np.ndarray) -> Iterator[pb.DetectFilmRequest]:
    """A client that sends half of its film and then nothing, without closing its side."""
    yield pb.DetectFilmRequest(header=header(film))
    yield from chunks(film[: len(film) // 2])
    time.sleep(3600)


@pytest.mark.parametrize(
    "stage",
    [pb.STAGE_RECEIVING, pb.STAGE_STABILISING, pb.STAGE_BACKGROUND, pb.STAGE_DETECTING],
    ids=["receiving", "stabilising", "background", "detecting"],
)
def test_a_cancelled_film_leaves_within_two_seconds(server: RunningServer, long_film: np.ndarray, stage: int) -> None:
    call = server.call(requests(long_film, no_stabilisation=stage > pb.STAGE_STABILISING))
    until(call, stage)
    assert server.spools() == 1
    call.cancel()
    eventually(lambda: server.spools() == 0, "the spool is gone", CANCEL_SECONDS)
    # The next film has its turn at once: nobody works on the cancelled one.
    begun = time.monotonic()
    assert max(p.films_ahead for p in server.detect(noise(2, 10, 10)).progress) == 0
    assert time.monotonic() - begun < CANCEL_SECONDS
    assert not finished(server, long_film)


def test_a_film_cancelled_while_it_waits_leaves_the_queue(server: RunningServer, long_film: np.ndarray) -> None:
    first = server.call(requests(long_film))
    until(first, pb.STAGE_STABILISING)
    second = server.call(requests(noise(3, 20, 20)))
    for response in second:
        if response.progress.films_ahead:
            break
    assert server.spools() == 2
    second.cancel()
    eventually(lambda: server.spools() == 1, "the waiting film's spool is gone", CANCEL_SECONDS)
    first.cancel()
    eventually(lambda: server.spools() == 0, "the working film's spool is gone", CANCEL_SECONDS)
    assert not finished(server, long_film)


def test_a_client_whose_deadline_has_passed_leaves_nothing(server: RunningServer, long_film: np.ndarray) -> None:
    with pytest.raises(grpc.RpcError) as late:
        answer(server.detection.DetectFilm(requests(long_film), metadata=server.metadata, timeout=0.7))
    assert late.value.code() is grpc.StatusCode.DEADLINE_EXCEEDED
    eventually(lambda: server.spools() == 0, "the spool is gone", CANCEL_SECONDS)
    assert not finished(server, long_film)


CLIENT = """
import sys, time
sys.path.insert(0, {tests!r})
import grpc
from memtrack.v1 import detection_pb2 as pb, detection_pb2_grpc
from server.running import TOKEN, noise
from server.test_endings import endless
stub = detection_pb2_grpc.DetectionServiceStub(grpc.insecure_channel({address!r}))
for response in stub.DetectFilm(endless(noise(20, 300, 400)), metadata=[("authorization", "Bearer " + TOKEN)]):
    print(response.WhichOneof("message"), flush=True)
"""


def test_a_killed_client_leaves_nothing(server: RunningServer) -> None:
    script = CLIENT.format(tests=str(Path(__file__).parent.parent), address=server.address)
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, encoding="utf-8") as client:
        assert client.stdout is not None
        assert client.stdout.readline() == "accepted\n"
        assert server.spools() == 1
        client.kill()
        client.wait()
    eventually(lambda: server.spools() == 0, "the spool is gone", CANCEL_SECONDS)


def test_a_silent_client_is_given_up(spool_folder: Path) -> None:
    with RunningServer(spool_folder, "--idle-seconds", "0.3") as server:
        with pytest.raises(grpc.RpcError) as given_up:
            answer(server.call(endless(noise(4, 20, 20))))
        assert given_up.value.code() is grpc.StatusCode.DEADLINE_EXCEEDED
        assert given_up.value.details() == "no frame came for 0.3 s, so the film was given up; run it again"
        eventually(lambda: server.spools() == 0, "the spool is gone", CANCEL_SECONDS)


def test_more_films_than_the_limit_are_refused(spool_folder: Path) -> None:
    with RunningServer(spool_folder, "--max-films", "1") as server:
        first = server.call(endless(noise(4, 20, 20)))
        next(first)
        with pytest.raises(grpc.RpcError) as refused:
            server.detect(noise(2, 10, 10))
        assert refused.value.code() is grpc.StatusCode.RESOURCE_EXHAUSTED
        assert refused.value.details() == ("the model server has 1 film(s) already, its limit; wait until one is done")
        first.cancel()
        eventually(lambda: server.spools() == 0, "the first film is gone", CANCEL_SECONDS)
        assert server.detect(noise(2, 10, 10)).summary[0].frame_count == 2


def test_a_film_larger_than_the_limit_is_refused_before_it_is_sent(spool_folder: Path) -> None:
    with RunningServer(spool_folder, "--max-film-bytes", "799") as server:
        with pytest.raises(grpc.RpcError) as refused:
            answer(server.call(endless(noise(2, 20, 20))))
        assert refused.value.code() is grpc.StatusCode.RESOURCE_EXHAUSTED
        assert str(refused.value.details()).startswith("the film has 0.0 MB, the server takes 0.0 MB; split it")
    with RunningServer(spool_folder, "--max-film-bytes", "800") as server:
        assert server.detect(noise(2, 20, 20)).summary[0].frame_count == 2


def test_a_killed_server_leaves_no_spool_and_the_client_hears_it(spool_folder: Path, long_film: np.ndarray) -> None:
    with RunningServer(spool_folder) as server:
        call = server.call(requests(long_film))
        until(call, pb.STAGE_STABILISING)
        server.process.kill()
        with pytest.raises(grpc.RpcError) as lost:
            answer(call)
        assert lost.value.code() is grpc.StatusCode.UNAVAILABLE
        server.process.wait()
    with RunningServer(spool_folder):
        assert list(spool_folder.glob("memtrack-spool-*")) == []


def test_the_end_of_standard_input_ends_the_server_and_its_films(spool_folder: Path, long_film: np.ndarray) -> None:
    with RunningServer(spool_folder) as server:
        call = server.call(requests(long_film))
        until(call, pb.STAGE_STABILISING)
        begun = time.monotonic()
        assert server.process.stdin is not None
        server.process.stdin.close()
        assert server.process.wait(PATIENCE_SECONDS) == 0
        assert time.monotonic() - begun < 3
        with pytest.raises(grpc.RpcError) as ended:
            answer(call)
        assert ended.value.code() is grpc.StatusCode.UNAVAILABLE
        assert ended.value.details() == "the model server is shutting down; run the film again"
        assert "ending: standard input was closed" in server.log


PARENT = """
import os, subprocess, sys
command = [sys.executable, "-m", "memtrack", "serve", "--spool-folder", sys.argv[1], "--parent-pid", str(os.getpid())]
server = subprocess.Popen(command)
sys.stdin.read()
"""


def test_the_death_of_the_parent_ends_the_server(spool_folder: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", PARENT, str(spool_folder)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        encoding="utf-8",
    ) as parent:
        assert parent.stdout is not None
        first_line = parent.stdout.readline()
        (server,) = psutil.Process(parent.pid).children()
        assert f'"pid": {server.pid}' in first_line
        assert server.is_running()
        parent.kill()
        parent.wait()
    eventually(lambda: not server.is_running() or server.status() == psutil.STATUS_ZOMBIE, "the server has ended", 5)


def test_a_parent_that_is_dead_already_ends_the_server(spool_folder: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", ""]) as gone:
        gone.wait()
    with RunningServer(spool_folder, "--parent-pid", str(gone.pid)) as server:
        assert server.process.wait(PATIENCE_SECONDS) == 0
        assert f"ending: parent process {gone.pid} has ended" in server.log


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGTERM that a process can catch")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_an_idle_server_at_once(spool_folder: Path, number: signal.Signals) -> None:
    with RunningServer(spool_folder, "--grace-seconds", str(10 * PATIENCE_SECONDS)) as server:
        begun = time.monotonic()
        server.process.send_signal(number)
        assert server.process.wait(PATIENCE_SECONDS) == 0
        assert time.monotonic() - begun < 2


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGTERM that a process can catch")
def test_a_signal_lets_a_film_finish_within_the_grace(spool_folder: Path) -> None:
    film = noise(60, 120, 160)
    with RunningServer(spool_folder, "--grace-seconds", "60") as server:
        call = server.call(requests(film))
        until(call, pb.STAGE_STABILISING)
        server.process.terminate()
        found = answer(call)
        assert found.summary[0].frame_count == 60
        assert finished(server, film)
        assert server.process.wait(PATIENCE_SECONDS) == 0


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGTERM that a process can catch")
def test_a_signal_ends_a_film_that_takes_longer_than_the_grace(spool_folder: Path, long_film: np.ndarray) -> None:
    with RunningServer(spool_folder, "--grace-seconds", "0.5") as server:
        call = server.call(requests(long_film))
        until(call, pb.STAGE_STABILISING)
        watch = health_pb2_grpc.HealthStub(server.channel).Watch(
            health_pb2.HealthCheckRequest(), timeout=PATIENCE_SECONDS
        )
        assert next(watch).status == health_pb2.HealthCheckResponse.SERVING
        begun = time.monotonic()
        server.process.terminate()
        assert next(watch).status == health_pb2.HealthCheckResponse.NOT_SERVING
        with pytest.raises(grpc.RpcError) as ended:
            answer(call)
        assert ended.value.code() is grpc.StatusCode.UNAVAILABLE
        assert ended.value.details() == "the model server is shutting down; run the film again"
        assert server.process.wait(PATIENCE_SECONDS) == 0
        assert time.monotonic() - begun < 4
        assert not finished(server, long_film)


def test_memory_returns_to_its_level_after_each_film(server: RunningServer) -> None:
    film = noise(40, 200, 300, "float32")
    process = psutil.Process(server.process.pid)

    def bytes_after(films: int) -> int:
        for _ in range(films):
            server.detect(film)
        return int(process.memory_info().rss)

    # The libraries take their room with the first films, and from film to film it varies by one or two.
    level = bytes_after(5)
    assert bytes_after(6) - level < 4 * film.nbytes, "each of six films left itself behind"
    assert server.spools() == 0
